// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// The rules of the house. Each looks through a source tree and returns what
/// breaks it, one line a violation, "file: what".
namespace ogive::policy
{
using Violations = std::vector<std::string>;
using Root       = std::filesystem::path;

/// core <- sph, fem <- coupling <- apps; sph and fem apart; core/base and
/// core/materials on the standard library and Eigen only.
Violations includes_against_the_graph(const Root &root);

/// ParameterHandler outside core/input and the *_parameters.cc files.
Violations parameter_handlers_out_of_place(const Root &root);

/// Source files that no CMakeLists.txt on their way up names.
Violations sources_left_out_of_the_build(const Root &root);

/// Scene folders without scene.prm or README.md.
Violations incomplete_scenes(const Root &root);

/// Commands in the sh blocks of README.md that no script holds, but for those of
/// the built program: another test runs them.
Violations readme_commands_unknown_to_the_scripts(const Root &root);

/// Source files of 500 lines or more.
Violations overlong_files(const Root &root);

/// Source files without the licence on their first line (second in a script).
Violations files_without_licence(const Root &root);
} // namespace ogive::policy
