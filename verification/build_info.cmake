# SPDX-License-Identifier: MIT
# Run at every build: writes OUTPUT with the revision, only when it changed.
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty OUTPUT_VARIABLE revision
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT revision)
  set(revision "no revision")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [=[// Written by the build.
#pragma once
#define HOMESPUN_VERSION "@VERSION@"
#define HOMESPUN_GIT_REVISION "@revision@"
#define HOMESPUN_DEALII_VERSION "@DEALII@"
#define HOMESPUN_TRILINOS_VERSION "@TRILINOS@"
#define HOMESPUN_CLI11_VERSION "@CLI11@"
#define HOMESPUN_BUILD_FLAGS "@FLAGS@"
#define HOMESPUN_PYTHON "@PYTHON@"
#define HOMESPUN_SOURCE_DIR "@SOURCE_DIR@"
#define HOMESPUN_BUILD_DIR "@BUILD_DIR@"
// Seen from the folder of the installed `homespun`; the second from that of `homespun-full`.
#define HOMESPUN_DATA_DIR "@DATA_DIR@"
#define HOMESPUN_DATA_DIR_OF_FULL "@DATA_DIR_OF_FULL@"
#define HOMESPUN_FULL_DIR "@FULL_DIR@"
]=] @ONLY)
