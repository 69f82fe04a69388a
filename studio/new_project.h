#pragma once
// From a design, a mesh or a standard cut to a project's folder. Nothing is overwritten.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace culet {

/// A file's name, from one that came from a browser or a file: no folder, nothing hidden, no sign
/// that anything but letters, digits, `.`, `-`, `_` and blanks could mean.
std::string plain_name(const std::string& given);

/// The stone file that a command line means; empty: none, the begin screen shows `folder`.
///
/// - a stone file: itself, in its folder;
/// - a folder: its stone.toml, or its only stone file;
/// - a mesh or design: the stone file of its own folder that names it as its mesh, else that of a
///   folder beside it, which is named as the file without its extension and gets a copy of it, a
///   stone.toml and an empty form readings.csv. If such a folder holds something else, the next
///   free one of NAME-2, NAME-3, ... is taken; one that holds this same design is used again.
///
/// Throws InputError for anything else.
std::filesystem::path stone_file_for(const std::filesystem::path& input);

/// The folder `stem`, `stem-2`, ... within `within`: one that holds a stone file and the file
/// `name` with these bytes already, or a new one. Throws InputError.
std::filesystem::path folder_for(const std::filesystem::path& within, const std::string& stem,
                                 const std::string& name, const std::string& bytes, bool& is_there);

/// Makes a project of a file's content (any mesh or design that culet reads) in a new folder within
/// `folder`; the same rules. `material`: a name of
/// the catalogue, or empty. Returns its stone file. Throws InputError.
std::filesystem::path project_of_file(const std::filesystem::path& folder,
                                      const std::string& file_name, const std::string& bytes,
                                      const std::string& material = {});

/// The same for a standard cut. `material` may be empty.
std::filesystem::path project_of_cut(const std::filesystem::path& folder, const std::string& kind,
                                     const std::map<std::string, double>& values,
                                     const std::string& material);

/// Stone files in `folder` and in the folders within it, in order of their names.
std::vector<std::filesystem::path> stone_files_in(const std::filesystem::path& folder);

/// What the begin screen offers, as JSON: the standard cuts with their parameters, materials,
/// stones in `folder` and the recent ones.
std::string begin_json(const std::filesystem::path& folder);

/// The projects that were opened last, the latest first, from a list in the user's state folder.
std::vector<std::filesystem::path> recent_projects();
/// Puts a project at the list's head. A list that cannot be written is left as it is.
void remember_project(const std::filesystem::path& stone_file);

}  // namespace culet
