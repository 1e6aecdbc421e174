// SPDX-License-Identifier: MIT
// Verdicts, and results as JSON files.
#pragma once

#include "verification/record/json_files.h"
#include "verification/record/verdict.h"
