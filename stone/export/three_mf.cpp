#include "stone/export/three_mf.h"

#include <fmt/format.h>
#include <zlib.h>

#include <cstdint>
#include <pugixml.hpp>
#include <sstream>
#include <vector>

#include "stone/solid/checks.h"
#include "stone/solid/facet_triangles.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// ZIP: each part with its header, then the directory (PKWARE's APPNOTE, 4.3).
class Archive {
public:
    void add(const std::string& name, const std::string& text) {
        const auto at = static_cast<std::uint32_t>(bytes_.size());
        const auto size = static_cast<std::uint32_t>(text.size());
        const auto sum =
            static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(text.data()), size));
        const auto header = [&](std::string& out) {
            constexpr int k_version = 20, k_flags = 0, k_stored = 0, k_time = 0, k_1980 = 33;
            for (const int value : {k_version, k_flags, k_stored, k_time, k_1980})
                put(out, std::uint32_t(value), 2);
            for (const std::uint32_t value : {sum, size, size}) put(out, value, 4);
            put(out, std::uint32_t(name.size()), 2);
            put(out, 0, 2);
        };
        put(bytes_, 0x04034b50, 4);
        header(bytes_);
        bytes_ += name + text;
        put(directory_, 0x02014b50, 4);
        put(directory_, 20, 2);
        header(directory_);
        for (const int size_of_nothing : {2, 2, 2, 4}) put(directory_, 0, size_of_nothing);
        put(directory_, at, 4);
        directory_ += name;
        ++parts_;
    }

    std::string bytes() const {
        std::string out = bytes_ + directory_;
        put(out, 0x06054b50, 4);
        put(out, 0, 4);
        put(out, parts_, 2);
        put(out, parts_, 2);
        put(out, std::uint32_t(directory_.size()), 4);
        put(out, std::uint32_t(bytes_.size()), 4);
        put(out, 0, 2);
        return out;
    }

private:
    static void put(std::string& out, std::uint32_t value, int size) {
        for (int i = 0; i < size; ++i) out.push_back(static_cast<char>(value >> (8 * i)));
    }

    std::string bytes_, directory_;
    std::uint32_t parts_ = 0;
};

pugi::xml_node child(pugi::xml_node of, const char* name,
                     const std::vector<std::pair<const char*, std::string>>& attributes) {
    pugi::xml_node node = of.append_child(name);
    for (const auto& [key, value] : attributes) node.append_attribute(key) = value.c_str();
    return node;
}

std::string text_of(const pugi::xml_document& document) {
    std::ostringstream out;
    document.save(out, "", pugi::format_raw, pugi::encoding_utf8);
    return out.str();
}

std::string model_text(const Solid& solid, const std::string& name) {
    pugi::xml_document document;
    pugi::xml_node model =
        child(document, "model",
              {{"unit", "millimeter"},
               {"xmlns", "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"}});
    child(model, "metadata", {{"name", "Title"}}).text() = name.c_str();
    pugi::xml_node object = child(model.append_child("resources"), "object",
                                  {{"id", "1"}, {"type", "model"}, {"name", name}});
    pugi::xml_node mesh = object.append_child("mesh"), vertices = mesh.append_child("vertices"),
                   triangles = mesh.append_child("triangles");
    for (const Vec3& v : solid.vertices) {
        child(vertices, "vertex",
              {{"x", fmt::format("{}", v.x)},
               {"y", fmt::format("{}", v.y)},
               {"z", fmt::format("{}", v.z)}});
    }
    for (const Facet& facet : solid.facets) {
        for (const std::array<int, 3>& t : facet_triangles(solid, facet)) {
            child(triangles, "triangle",
                  {{"v1", std::to_string(t[0])},
                   {"v2", std::to_string(t[1])},
                   {"v3", std::to_string(t[2])}});
        }
    }
    child(model.append_child("build"), "item", {{"objectid", "1"}});
    return text_of(document);
}

}  // namespace

std::string three_mf_bytes(const Solid& solid, const std::string& name) {
    if (!is_closed(solid))
        throw InputError("a 3MF file holds closed solids only, and this one is open: culet info");
    pugi::xml_document types, relations;
    pugi::xml_node list =
        child(types, "Types",
              {{"xmlns", "http://schemas.openxmlformats.org/package/2006/content-types"}});
    child(list, "Default",
          {{"Extension", "rels"},
           {"ContentType", "application/vnd.openxmlformats-package.relationships+xml"}});
    child(list, "Default",
          {{"Extension", "model"},
           {"ContentType", "application/vnd.ms-package.3dmanufacturing-3dmodel+xml"}});
    child(child(relations, "Relationships",
                {{"xmlns", "http://schemas.openxmlformats.org/package/2006/relationships"}}),
          "Relationship",
          {{"Target", "/3D/3dmodel.model"},
           {"Id", "rel0"},
           {"Type", "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"}});
    Archive archive;
    archive.add("[Content_Types].xml", text_of(types));
    archive.add("_rels/.rels", text_of(relations));
    archive.add("3D/3dmodel.model", model_text(solid, name));
    return archive.bytes();
}

}  // namespace culet
