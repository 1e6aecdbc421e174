// SPDX-License-Identifier: MIT
// The version of the files that the program writes for others and for itself: one number for all.
// It grows when a reader of before would misread a file or could not use it; datasets, keys and
// tables that are added leave it as it is, because readers skip what they do not know. A table
// whose columns change, names itself by its header, which every reader compares.
//
//   .h5     attribute `format_version` of the file
//   .json   key `format_version`, the first one
//   .csv    that of run.json in the same folder, since a folder is one run of one program; a line
//   or
//           a column of its own would get in the way of every other reader
//
// Files without it are older than it, version 0; there is none so far that is not read.
#pragma once

#include <string>

namespace homespun::meshes
{
constexpr int format_version = 1;

/// Why a file of this version is not read; empty where it is.
/// @param path of the file, with which the message begins
std::string fault_of_format(const std::string &path, int found);

/// The same for what is no whole number.
/// @param found as text
std::string fault_of_format(const std::string &path, const std::string &found);
} // namespace homespun::meshes
