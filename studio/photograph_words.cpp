#include "studio/photograph_words.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "page/parts.h"

namespace culet {

// Advice on options of the command line is turned into what this page has.
std::string reworded(std::string text) {
    const std::pair<const char*, const char*> words[] = {
        {"give it with --mask", "name it in job.toml, below [compare], as mask"},
        {"give a mask with --mask",
         "lay the outline on the stone by hand, and say that it counts as placed"},
        {" to where it was and say --keep-pose", " there and lay it on again"},
        {"culet compare refines", "the comparison refines"},
        {"See the overlay: ", ""},
        {"the scene's camera", "the outline"}};
    for (const auto& [from, to] : words) {
        for (std::size_t at; (at = text.find(from)) != std::string::npos;)
            text.replace(at, std::string_view(from).size(), to);
    }
    return text;
}

namespace {

std::string without_options(std::string text) {
    for (std::size_t at; (at = text.find(" (--")) != std::string::npos;)
        text.erase(at, text.find(')', at) + 1 - at);
    // A clause about another option goes.
    for (std::size_t at; (at = text.find(" --")) != std::string::npos;) {
        const std::size_t begin = text.find_last_of(",;.", at);
        const std::size_t end = std::min(text.find_first_of(",;", at), text.size());
        const std::size_t from = begin == std::string::npos ? 0 : begin;
        text.erase(from, end - from + (from == 0 && end < text.size() ? 5 : 0));
    }
    return text;
}

}  // namespace

std::string sentences(const std::string& text) {
    std::string told = without_options(reworded(text));
    if (!told.empty())
        told[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(told[0])));
    if (!told.empty() && told.back() != '.') told += '.';
    return told;
}

std::string pose_card(const FoundPose& pose) {
    std::string text;
    if (!pose.usable()) {
        text = sentences(pose.trouble) + " " + sentences(pose.remedy);
        return verdict_card("bad", "✕", "Not laid on", text);
    }
    for (const std::string& words : pose_words(pose)) text += sentences(words) + " ";
    text.pop_back();
    return pose.sigmas.angle_99 > k_sure_pose || !pose.warnings.empty()
               ? verdict_card("fair", "≈", "Laid on, with some doubt", text)
               : verdict_card("good", "✓", "Laid on", text);
}

}  // namespace culet
