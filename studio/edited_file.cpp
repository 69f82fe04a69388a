#include "studio/edited_file.h"

#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_decoding.h"

namespace culet {

namespace {

constexpr std::size_t k_largest_text = 8u << 20;

}  // namespace

EditedFile::EditedFile(std::filesystem::path file) : file_(std::move(file)) {
    text_ = decoded_text(read_text(file_, k_largest_text), file_);
    note_stamp();
    states_.push_back(text_);
}

void EditedFile::note_stamp() {
    std::error_code ignored;
    time_ = std::filesystem::last_write_time(file_, ignored);
    size_ = std::filesystem::file_size(file_, ignored);
}

bool EditedFile::changed_outside() {
    std::error_code gone;
    const auto time = std::filesystem::last_write_time(file_, gone);
    const auto size = gone ? 0 : std::filesystem::file_size(file_, gone);
    if (gone) {
        other_.clear();
        return true;
    }
    if (time == time_ && size == size_) return false;
    try {
        other_ = decoded_text(read_text(file_, k_largest_text), file_);
    } catch (const InputError&) {
        other_.clear();
        return true;
    }
    if (other_ != text_) return true;
    note_stamp();
    return false;
}

void EditedFile::write(const std::string& text) {
    if (changed_outside()) {
        throw InputError(file_, "was changed by another program: say first which of the two stays");
    }
    write_text(file_, text);
    text_ = text;
    note_stamp();
}

void EditedFile::add_state(const std::string& text) {
    states_.resize(at_ + 1);
    states_.push_back(text);
    const std::size_t most =
        std::min(k_history_steps, 2 + k_history_bytes / std::max<std::size_t>(text.size(), 1));
    if (states_.size() > most) states_.erase(states_.begin());
    at_ = states_.size() - 1;
}

void EditedFile::save(const std::string& text) {
    if (text == text_) return;
    write(text);
    add_state(text);
}

void EditedFile::undo() {
    if (!can_undo()) throw InputError("there is nothing to undo");
    write(states_[at_ - 1]);
    --at_;
}

void EditedFile::redo() {
    if (!can_redo()) throw InputError("there is nothing to redo");
    write(states_[at_ + 1]);
    ++at_;
}

void EditedFile::take_other() {
    if (!changed_outside()) return;
    text_ = decoded_text(read_text(file_, k_largest_text), file_);
    note_stamp();
    add_state(text_);
}

void EditedFile::keep_own() {
    if (!changed_outside()) return;
    const std::string own = text_;
    write_text(file_, own);
    note_stamp();
    if (other_.empty()) return;
    add_state(other_);
    add_state(own);
}

}  // namespace culet
