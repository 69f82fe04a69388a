#include "bench/studies/source_page.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>

#include "bench/studies/templates.h"
#include "page/html.h"
#include "page/parts.h"
#include "page/study_sections.h"
#include "render/image/exposure.h"
#include "render/image/shown_bytes.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// A page has a dozen pictures; JPEGs are a sixth of the size of PNGs.
constexpr int k_jpeg_quality = 88;

std::string jpeg_uri(const CaptionedPicture& shown) {
    const Picture& picture = shown.picture;
    std::vector<std::uint8_t> bytes = shown_bytes(picture, shown.look, false);
    for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) std::swap(bytes[i], bytes[i + 2]);
    const cv::Mat mat(picture.height, picture.width, CV_8UC3, bytes.data());
    std::vector<unsigned char> jpeg;
    check(cv::imencode(".jpg", mat, jpeg, {cv::IMWRITE_JPEG_QUALITY, k_jpeg_quality}),
          "a picture is encoded");
    return "data:image/jpeg;base64," +
           base64({reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
}

std::vector<View> cells_of(const std::vector<std::string>& texts) {
    std::vector<View> cells;
    for (std::size_t i = 0; i < texts.size(); ++i)
        cells.push_back({{"text", texts[i]}, {"name", i == 0}, {"number", i != 0}});
    return cells;
}

View table_of(const std::string& caption, const std::vector<std::string>& columns,
              const std::vector<std::vector<std::string>>& rows) {
    std::vector<View> lines;
    for (const auto& row : rows) {
        check(row.size() == columns.size(), "a row has as many cells as the table has columns");
        lines.push_back({{"cells", cells_of(row)}});
    }
    return {{"caption", caption}, {"columns", cells_of(columns)}, {"rows", std::move(lines)}};
}

}  // namespace

SourcePage::SourcePage(std::string name, std::string title, std::string source)
    : name_(std::move(name)), title_(std::move(title)), source_(std::move(source)) {}

void SourcePage::section(const std::string& heading) {
    sections_.push_back({heading, {}});
}

View SourcePage::Part::view() const {
    return {{"words", words},
            {"learned", learned},
            {"tables", tables},
            {"chart_html", chart_html},
            {"pictures", pictures}};
}

View SourcePage::Section::view(std::size_t number) const {
    std::vector<View> blocks;
    for (const Part& part : parts) blocks.push_back(part.view());
    return {{"id", fmt::format("section-{}", number)},
            {"heading", heading},
            {"blocks", std::move(blocks)}};
}

void SourcePage::add(Part part) {
    check(!sections_.empty(), "a part stands in a section");
    sections_.back().parts.push_back(std::move(part));
}

void SourcePage::words(const std::string& paragraph) {
    add({.words = paragraph});
}

void SourcePage::learned(const std::string& sentence) {
    add({.learned = sentence});
}

void SourcePage::table(const std::string& caption, const std::vector<std::string>& columns,
                       const std::vector<std::vector<std::string>>& rows) {
    add({.tables = {table_of(caption, columns, rows)}});
}

void SourcePage::chart(const Chart& chart) {
    add({.chart_html = chart_figure(draw_chart_svg(chart))});
}

void SourcePage::pictures(const std::vector<CaptionedPicture>& row) {
    std::vector<View> views;
    for (const CaptionedPicture& one : row)
        views.push_back({{"caption", one.caption}, {"uri_html", jpeg_uri(one)}});
    add({.pictures = {View{{"row", std::move(views)}}}});
}

std::string SourcePage::html(const std::vector<std::vector<std::string>>& parameters) const {
    SourcePage whole = *this;
    whole.section("Parameters");
    whole.table("As used for this page", {"Parameter", "Value"}, parameters);
    std::vector<View> sections;
    for (const Section& one : whole.sections_) sections.push_back(one.view(sections.size() + 1));
    return html_page(title_, filled(templates::source_page, {{"title", title_},
                                                             {"source", source_},
                                                             {"name", name_},
                                                             {"sections", std::move(sections)}}));
}

PngLook exposed_for(const Picture& picture) {
    PngLook look;
    look.exposure = exposure_for_stone(picture);
    return look;
}

}  // namespace culet
