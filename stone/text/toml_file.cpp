#include "stone/text/toml_file.h"

#include "stone/text/output_file.h"
#include "stone/text/text_decoding.h"
#include "stone/text/toml_parse.h"

namespace culet {

namespace {

constexpr std::size_t k_limit_bytes = 64u << 20;

toml::table parsed(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    return parse_toml(decoded_text(read_text(file, k_limit_bytes), file), file, overrides);
}

}  // namespace

TomlTable read_toml(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    return read_toml_with(file, {}, overrides);
}

TomlTable read_toml_with(const std::filesystem::path& file,
                         const std::vector<std::pair<std::string, std::string>>& texts,
                         const std::vector<std::string>& overrides) {
    auto content = std::make_shared<TomlTable::Content>();
    content->file = file;
    content->root = parsed(file, {});
    for (const auto& [key, text] : texts) content->root.insert_or_assign(key, text);
    for (const std::string& setting : overrides) apply_override(content->root, setting);
    TomlTable table;
    table.node_ = &content->root;
    table.content_ = std::move(content);
    return table;
}

TomlTable toml_beside(const std::filesystem::path& file,
                      const std::vector<std::pair<std::string, std::string>>& texts,
                      const std::vector<std::string>& overrides, HeldFiles files) {
    auto content = std::make_shared<TomlTable::Content>();
    content->file = file;
    content->held = std::move(files);
    for (const auto& [key, text] : texts) content->root.insert_or_assign(key, text);
    for (const std::string& setting : overrides) apply_override(content->root, setting);
    TomlTable table;
    table.node_ = &content->root;
    table.content_ = std::move(content);
    return table;
}

TomlTable toml_of_text(std::string_view text, const std::filesystem::path& name,
                       const std::vector<std::string>& overrides, HeldFiles files) {
    auto content = std::make_shared<TomlTable::Content>();
    content->file = name;
    content->root = parse_toml(text, name, overrides);
    content->held = std::move(files);
    TomlTable table;
    table.node_ = &content->root;
    table.content_ = std::move(content);
    return table;
}

std::string rewritten_toml(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides,
                           const std::vector<std::string>& without,
                           const std::filesystem::path& folder) {
    toml::table root = parsed(file, overrides);
    erase_keys(root, without);
    move_paths(root, file.parent_path(), folder);
    return formatted_toml(root);
}

std::string rewritten_text(std::string_view text, const std::filesystem::path& name,
                           const std::vector<std::string>& overrides,
                           const std::vector<std::string>& without) {
    toml::table root = parse_toml(text, name, overrides);
    erase_keys(root, without);
    return formatted_toml(root);
}

}  // namespace culet
