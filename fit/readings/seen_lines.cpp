#include "fit/readings/seen_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "stone/text/errors.h"
#include "stone/text/name_suggestions.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

using Json = nlohmann::json;
using MatrixRows = std::vector<std::vector<double>>;
using Projections = std::map<std::string, glm::dmat4x3>;  // by the frame's file

// Points whose spread across is more than this part of that along are on no line.
constexpr double k_roundest = 0.5;

std::optional<glm::dmat4x3> matrix_of(const MatrixRows& rows) {
    glm::dmat4x3 matrix(0.0);
    if (rows.size() != 3) return std::nullopt;
    for (int r = 0; r < 3; ++r) {
        if (rows[std::size_t(r)].size() != 4) return std::nullopt;
        for (int c = 0; c < 4; ++c) matrix[c][r] = rows[std::size_t(r)][std::size_t(c)];
    }
    return matrix;
}

// Of a file that culet spin wrote.
Projections read_projections(const std::filesystem::path& file) {
    Projections found;
    try {
        const Json spin = Json::parse(read_text(file));
        for (const Json& frame : spin.at("frames")) {
            if (!frame.contains("projection")) continue;
            const auto matrix = matrix_of(frame["projection"].get<MatrixRows>());
            if (!matrix) throw InputError(file, "a `projection` is not three rows of four numbers");
            found.emplace(frame.at("file").get<std::string>(), *matrix);
        }
    } catch (const Json::exception&) {
        throw InputError(file,
                         "is not a file of `culet spin --json`: {\"frames\": [{\"file\", "
                         "\"projection\"}]} is expected");
    }
    return found;
}

glm::dmat4x3 projection_of(const TomlTable& table,
                           std::map<std::filesystem::path, Projections>& files) {
    const auto rows = table.rows("projection", 4);
    const auto file = table.path("file");
    const auto frame = table.text("frame");
    if (rows.has_value() == (file && frame) || file.has_value() != frame.has_value()) {
        table.fail("",
                   "a [[line]] needs projection = [[..4 numbers..], [..], [..]], or file = "
                   "\"spin.json\" and frame = \"f001.jpg\"");
    }
    if (rows) {
        if (const auto matrix = matrix_of(*rows)) return *matrix;
        table.fail("projection",
                   fmt::format("projection must have three rows, found {}", rows->size()));
    }
    const auto known = files.find(*file);
    const Projections& all = known != files.end()
                                 ? known->second
                                 : files.emplace(*file, read_projections(*file)).first->second;
    const auto found = all.find(*frame);
    if (found != all.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [name, projection] : all) names.push_back(name);
    const auto near = nearest_name(*frame, names);
    table.fail("frame",
               fmt::format("{} has no frame \"{}\"{}", file->filename().string(), shown(*frame),
                           near ? fmt::format(" (did you mean \"{}\"?)", *near) : ""));
}

SeenLine line_of(const TomlTable& table, std::map<std::filesystem::path, Projections>& files) {
    const glm::dmat4x3 projection = projection_of(table, files);
    std::vector<glm::dvec2> points;
    for (const auto& p : table.rows("points", 2).value_or(MatrixRows()))
        points.emplace_back(p[0], p[1]);
    try {
        SeenLine line = line_through(std::move(points), projection);
        line.series = table.text("file").value_or("");
        return line;
    } catch (const InputError& error) {
        table.fail("points", error.what());
    }
}

}  // namespace

SeenLine line_through(std::vector<glm::dvec2> points, const glm::dmat4x3& projection) {
    if (points.size() < 2) {
        throw InputError(fmt::format(
            "points = [[u, v], ...] must have two pixels or more, found {}", points.size()));
    }
    SeenLine line;
    line.projection = projection;
    const double count = double(points.size());
    for (const glm::dvec2& p : points) line.middle += p / count;
    double xx = 0, yy = 0, xy = 0;
    for (const glm::dvec2& p : points) {
        const glm::dvec2 d = p - line.middle;
        xx += d.x * d.x;
        yy += d.y * d.y;
        xy += d.x * d.y;
    }
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    line.along = {std::cos(angle), std::sin(angle)};
    for (const glm::dvec2& p : points) {
        const glm::dvec2 d = p - line.middle;
        const double across = line.along.x * d.y - line.along.y * d.x;
        line.scatter += across * across;
    }
    const double spread = xx + yy - line.scatter;
    if (!(spread > 0)) throw InputError("all points are at one place");
    if (line.scatter > k_roundest * k_roundest * spread) throw InputError("points lie on no line");
    line.reach = std::sqrt((spread - line.scatter) / count);
    line.points = std::move(points);
    return line;
}

std::vector<WrittenReading> read_lines(const TomlTable& root) {
    std::vector<WrittenReading> all;
    std::map<std::filesystem::path, Projections> files;
    for (const TomlTable& table : root.tables("line")) {
        table.refuse_unknown(
            {"of", "projection", "file", "frame", "points", "sigma", "id", "note"});
        WrittenReading reading;
        reading.kind = name_of(ReadingKind::line);
        reading.id = table.text("id").value_or(fmt::format("line{}", all.size()));
        reading.of = table.texts("of").value_or(std::vector<std::string>());
        reading.note = table.text("note").value_or("");
        reading.file = table.file();
        reading.line = table.line();
        reading.sigma = table.number("sigma");
        if (!reading.sigma || !(*reading.sigma > 0)) {
            table.fail("sigma",
                       "sigma must be positive: one standard uncertainty of a point across the "
                       "line, in pixels");
        }
        reading.seen_line = std::make_shared<const SeenLine>(line_of(table, files));
        all.push_back(std::move(reading));
    }
    return all;
}

}  // namespace culet
