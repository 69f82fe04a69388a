#pragma once
// A page about one of culet's sources: what it reports, what culet finds, and what was learned.

#include <string>
#include <vector>

#include "page/chart.h"
#include "page/template.h"
#include "render/image/film_look.h"
#include "render/image/picture.h"

namespace culet {

struct CaptionedPicture {
    std::string caption;
    Picture picture;
    PngLook look;
};

/// Parts of a page, in reading order. Texts are plain and get escaped.
class SourcePage {
public:
    /// `name`: as in `sh bench/studies.sh NAME`; `source`: authors, title, year.
    SourcePage(std::string name, std::string title, std::string source);

    void section(const std::string& heading);
    void words(const std::string& paragraph);
    /// The first column has names, the others numbers.
    void table(const std::string& caption, const std::vector<std::string>& columns,
               const std::vector<std::vector<std::string>>& rows);
    void chart(const Chart& chart);
    void pictures(const std::vector<CaptionedPicture>& row);
    /// The study's concluding sentence.
    void learned(const std::string& sentence);

    const std::string& name() const { return name_; }
    /// `parameters`: keys and values used.
    std::string html(const std::vector<std::vector<std::string>>& parameters) const;

private:
    struct Part {
        std::string words = {}, learned = {}, chart_html = {};
        std::vector<View> tables = {}, pictures = {};
        View view() const;
    };
    struct Section {
        std::string heading;
        std::vector<Part> parts;
        View view(std::size_t number) const;
    };
    void add(Part part);

    std::string name_, title_, source_;
    std::vector<Section> sections_;
};

/// Exposed for its stone (exposure_for_stone).
PngLook exposed_for(const Picture& picture);

}  // namespace culet
