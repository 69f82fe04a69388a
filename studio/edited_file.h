#pragma once
// A text file that is saved at every change, with its history. What another program changed is
// never overwritten unasked.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace culet {

class EditedFile {
public:
    /// Reads the file. Throws InputError.
    explicit EditedFile(std::filesystem::path file);

    const std::filesystem::path& path() const { return file_; }
    /// As read or saved last: UTF-8, without the bytes that other encodings add.
    const std::string& text() const { return text_; }

    /// Another program changed, or removed, the file, and nobody has said yet which text stays.
    /// Looks at time and size, and at the content where one of them differs.
    bool changed_outside();

    /// Saves at once, completely or not at all. The text before can be had back. Throws InputError
    /// if the file cannot be written or was changed outside, and then changes nothing.
    void save(const std::string& text);
    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ + 1 < states_.size(); }
    /// Throw InputError as `save` does, and where there is nothing to undo or redo.
    void undo();
    void redo();

    /// After a change outside: its text becomes a step of the history, and so can be undone.
    void take_other();
    /// The same, but the own text is saved after it.
    void keep_own();

private:
    void write(const std::string& text);
    void add_state(const std::string& text);
    void note_stamp();

    std::filesystem::path file_;
    std::string text_, other_;  // `other_`: what was found instead
    std::filesystem::file_time_type time_{};
    std::uintmax_t size_ = 0;
    std::vector<std::string> states_;
    std::size_t at_ = 0;
};

/// Older states are forgotten beyond this many bytes, or steps.
inline constexpr std::size_t k_history_bytes = 32u << 20, k_history_steps = 1000;

}  // namespace culet
