#pragma once
// A TOML file as culet reads it: typed values, and errors with file, line and key.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace culet {

/// Files that came with a text, by the names that it uses.
using HeldFiles = std::map<std::string, std::string, std::less<>>;

/// One table of a file. A missing key gives nothing. A value of the wrong type, NaN or Inf throws
/// InputError with file, line, what was found and what was expected.
class TomlTable {
public:
    bool has(std::string_view key) const;
    std::optional<double> number(std::string_view key) const;
    std::optional<std::int64_t> integer(std::string_view key) const;
    std::optional<bool> boolean(std::string_view key) const;
    std::optional<std::string> text(std::string_view key) const;   ///< or a date: 2026-01-31
    std::optional<glm::dvec3> vector(std::string_view key) const;  ///< three numbers
    std::optional<std::vector<double>> numbers(std::string_view key) const;
    std::optional<std::vector<std::string>> texts(std::string_view key) const;
    /// A text, a number or a list of either, as texts (numbers in their shortest form).
    std::optional<std::vector<std::string>> words(std::string_view key) const;
    std::optional<std::vector<glm::dvec3>> vectors(std::string_view key) const;
    /// Lists of `size` numbers each, up to four.
    std::optional<std::vector<std::vector<double>>> rows(std::string_view key,
                                                         std::size_t size) const;
    std::optional<TomlTable> table(std::string_view key) const;
    std::vector<TomlTable> tables(std::string_view key) const;  ///< `[[key]]`; empty when missing

    enum class Kind { missing, number, boolean, text, list, table, other };
    Kind kind(std::string_view key) const;

    /// Paths are resolved against the file's folder.
    std::optional<std::filesystem::path> path(std::string_view key) const;
    /// A file that came with the text; null: read it from disk.
    const std::string* held_file(std::string_view key) const;

    /// Throws InputError for the first key that is not in `known`, with the nearest known one.
    void refuse_unknown(const std::vector<std::string_view>& known) const;
    /// Throws InputError at the line of `key` (or of the table when the key is missing).
    [[noreturn]] void fail(std::string_view key, const std::string& message) const;

    const std::filesystem::path& file() const;
    long line() const;  ///< of the table; 0 when it came from the command line

private:
    struct Content;
    std::shared_ptr<const Content> content_;
    const void* node_ = nullptr;  // a toml::table inside content_
    std::string name_;
    friend TomlTable read_toml_with(const std::filesystem::path&,
                                    const std::vector<std::pair<std::string, std::string>>&,
                                    const std::vector<std::string>&);
    friend TomlTable toml_beside(const std::filesystem::path&,
                                 const std::vector<std::pair<std::string, std::string>>&,
                                 const std::vector<std::string>&, HeldFiles);
    friend TomlTable toml_of_text(std::string_view, const std::filesystem::path&,
                                  const std::vector<std::string>&, HeldFiles);
};

/// Applies `key.path=value` overrides. The value is TOML (a number, "text", [list]), else taken as
/// text. `reading.2.sigma=0.1` addresses a list item, counted from 0. Throws InputError.
TomlTable read_toml(const std::filesystem::path& file,
                    const std::vector<std::string>& overrides = {});

/// The same with `texts`, keys and values, replacing the file's own.
TomlTable read_toml_with(const std::filesystem::path& file,
                         const std::vector<std::pair<std::string, std::string>>& texts,
                         const std::vector<std::string>& overrides);

/// A table without a file, from keys and values, with the files that they name. Paths are resolved
/// against the folder of `file`, which is not read; errors name it. Throws InputError.
TomlTable toml_beside(const std::filesystem::path& file,
                      const std::vector<std::pair<std::string, std::string>>& texts,
                      const std::vector<std::string>& overrides = {}, HeldFiles files = {});

/// The same for a text without a file; errors call it `name`. Throws InputError.
TomlTable toml_of_text(std::string_view text, const std::filesystem::path& name,
                       const std::vector<std::string>& overrides = {}, HeldFiles files = {});

/// A file's text with `overrides` applied and the keys `without` (camera.fov) removed, to be stored
/// in `folder`: relative file names are adapted. Comments are lost and keys sorted. Throws
/// InputError.
std::string rewritten_toml(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides,
                           const std::vector<std::string>& without,
                           const std::filesystem::path& folder);

/// The same for a text without a file; its paths stay as they are and errors call it `name`.
std::string rewritten_text(std::string_view text, const std::filesystem::path& name,
                           const std::vector<std::string>& overrides,
                           const std::vector<std::string>& without);

}  // namespace culet
