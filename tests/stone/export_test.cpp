// Files for other programs, read back here by the formats' rules: the volume is that of the solid.

#include <gtest/gtest.h>

#include <cstring>
#include <glm/geometric.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "stone/cuts/cuts.h"
#include "stone/export/export_frame.h"
#include "stone/export/gltf_write.h"
#include "stone/export/step.h"
#include "stone/export/three_mf.h"
#include "stone/solid/checks.h"
#include "stone/solid_input.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "tests/scratch_folder.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

using Json = nlohmann::json;

// Entities of a STEP file by number: name and the content of the brackets.
struct Entity {
    std::string name, text;
    std::vector<int> refers;
};
std::map<int, Entity> entities_of(const std::string& step) {
    std::map<int, Entity> entities;
    const std::regex line("#(\\d+)=([A-Z_0-9]+)\\((.*)\\);"), number("#(\\d+)");
    for (std::sregex_iterator i(step.begin(), step.end(), line), end; i != end; ++i) {
        Entity entity{(*i)[2], (*i)[3], {}};
        for (std::sregex_iterator k(entity.text.begin(), entity.text.end(), number); k != end; ++k)
            entity.refers.push_back(std::stoi((*k)[1]));
        entities[std::stoi((*i)[1])] = entity;
    }
    return entities;
}

Vec3 point_of(const std::string& text) {
    Vec3 p(0);
    const std::size_t at = text.find(",(");
    EXPECT_EQ(std::sscanf(text.c_str() + at + 2, "%lf,%lf,%lf", &p.x, &p.y, &p.z), 3) << text;
    return p;
}

// Every edge is used once in each direction; the corners of each face bound it; Gauss's theorem.
TEST(Step, IsAClosedBodyOfTheSameVolume) {
    for (const char* cut : {"round-brilliant", "emerald", "pear"}) {
        const Solid solid = make_cut(cut);
        const std::map<int, Entity> all = entities_of(step_text(solid, cut).text);
        std::map<int, int> uses, sum_of_ways;
        double volume6 = 0;
        int faces = 0, bodies = 0;
        for (const auto& [id, entity] : all) {
            if (entity.name == "MANIFOLD_SOLID_BREP") ++bodies;
            if (entity.name != "ADVANCED_FACE") continue;
            ++faces;
            const std::string name = entity.text.substr(1, entity.text.find('\'', 1) - 1);
            EXPECT_GE(find_facet(solid, name), 0) << name;
            const Entity& loop = all.at(all.at(entity.refers[0]).refers[0]);
            ASSERT_EQ(loop.name, "EDGE_LOOP");
            std::vector<Vec3> corners;
            for (const int oriented : loop.refers) {
                const Entity& use = all.at(oriented);
                const bool forward = use.text.ends_with(".T.");
                const int edge = use.refers[0];
                ++uses[edge];
                sum_of_ways[edge] += forward ? 1 : -1;
                const int vertex = all.at(edge).refers[forward ? 0 : 1];
                corners.push_back(point_of(all.at(all.at(vertex).refers[0]).text));
            }
            for (std::size_t k = 1; k + 1 < corners.size(); ++k)
                volume6 += glm::dot(corners[0], glm::cross(corners[k], corners[k + 1]));
        }
        EXPECT_EQ(bodies, 1);
        EXPECT_EQ(std::size_t(faces), solid.facets.size()) << cut;
        for (const auto& [edge, count] : uses) {
            EXPECT_EQ(count, 2) << edge;
            EXPECT_EQ(sum_of_ways[edge], 0) << edge;
        }
        // Corners have all their digits; their planes may miss them by 1e-5 mm over the surface.
        EXPECT_NEAR(volume6 / 6, volume(solid), 1e-9 * volume(solid)) << cut;
        EXPECT_EQ(step_text(solid, cut).text, step_text(solid, cut).text);
    }
}

struct Glb {
    Json json;
    std::string bytes;
};
Glb glb_of(const std::string& file) {
    std::uint32_t words[5];
    std::memcpy(words, file.data(), sizeof words);
    EXPECT_EQ(words[0], 0x46546C67u);
    EXPECT_EQ(words[1], 2u);
    EXPECT_EQ(words[2], file.size());
    EXPECT_EQ(words[3] % 4, 0u);
    EXPECT_EQ(words[4], 0x4E4F534Au);
    return {Json::parse(file.substr(20, words[3])), file.substr(28 + words[3])};
}

std::vector<Vec3> vectors_of(const Glb& glb, int accessor) {
    const Json& a = glb.json["accessors"][accessor];
    const Json& view = glb.json["bufferViews"][a["bufferView"].get<int>()];
    const std::size_t start = view.value("byteOffset", std::size_t(0));
    EXPECT_EQ(start % 4, 0u);
    std::vector<Vec3> vectors;
    for (std::size_t i = 0; i < a["count"].get<std::size_t>(); ++i) {
        float xyz[3];
        std::memcpy(xyz, glb.bytes.data() + start + 12 * i, 12);
        vectors.push_back({double(xyz[0]), double(xyz[1]), double(xyz[2])});
    }
    return vectors;
}

// The rules of glTF 2.0 that readers rely on, and the true size in metres.
TEST(Gltf, KeepsTheRulesAndTheSize) {
    Stone stone;
    stone.solid = make_cut("round-brilliant");
    stone.material = catalogue_material("diamond");
    const Glb glb = glb_of(gltf_bytes(stone, gltf_look_of(stone.material), GltfForm::binary));
    EXPECT_EQ(glb.json["asset"]["version"], "2.0");
    std::set<std::string> used;
    for (const Json& name : glb.json["extensionsUsed"]) used.insert(name);
    for (const auto& [name, value] : glb.json["materials"][0]["extensions"].items())
        EXPECT_EQ(used.count(name), 1u) << name;
    EXPECT_FALSE(glb.json.contains("extensionsRequired"));
    const Json& primitive = glb.json["meshes"][0]["primitives"][0];
    const int positions = primitive["attributes"]["POSITION"];
    const std::vector<Vec3> places = vectors_of(glb, positions);
    Vec3 low(1e300), high(-1e300);
    for (const Vec3& p : places) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(low[k], glb.json["accessors"][positions]["min"][k].get<double>());
        EXPECT_EQ(high[k], glb.json["accessors"][positions]["max"][k].get<double>());
    }
    for (const Vec3& n : vectors_of(glb, primitive["attributes"]["NORMAL"]))
        EXPECT_NEAR(glm::length(n), 1, 1e-6);
    const Json& indices = glb.json["accessors"][primitive["indices"].get<int>()];
    ASSERT_EQ(indices["componentType"], 5123);
    const Json& view = glb.json["bufferViews"][indices["bufferView"].get<int>()];
    double volume6 = 0;
    for (std::size_t i = 0; i < indices["count"].get<std::size_t>(); i += 3) {
        std::uint16_t corner[3];
        std::memcpy(corner, glb.bytes.data() + view["byteOffset"].get<std::size_t>() + 2 * i, 6);
        for (const std::uint16_t c : corner) ASSERT_LT(c, places.size());
        volume6 += glm::dot(places[corner[0]], glm::cross(places[corner[1]], places[corner[2]]));
    }
    // Single precision of every corner.
    EXPECT_NEAR(volume6 / 6 * 1e9, volume(stone.solid), 1e-5 * volume(stone.solid));
    // The table is up, which is +y; every facet has its name.
    EXPECT_GT(vectors_of(glb, primitive["attributes"]["NORMAL"])[0].y, 0.999);
    const Json& facets = glb.json["meshes"][0]["extras"]["facets"];
    ASSERT_EQ(facets.size(), stone.solid.facets.size());
    EXPECT_EQ(facets[0]["name"], "T");
    // Sellmeier's diamond at the d line (Peter 1923: 2.4175), Abbe's number 55.3.
    const Json& extensions = glb.json["materials"][0]["extensions"];
    EXPECT_NEAR(extensions["KHR_materials_ior"]["ior"].get<double>(), 2.4175, 1e-3);
    EXPECT_NEAR(extensions["KHR_materials_dispersion"]["dispersion"].get<double>(), 20 / 55.3,
                0.01);
}

// Planes move out by the clearance, so every corner of the stone is inside by as much.
// What is exported comes back: the facets by name, in mm and single precision.
TEST(Gltf, ComesBackWithItsNames) {
    const test::ScratchFolder folder;
    Stone stone;
    stone.solid = make_cut("emerald");
    stone = in_export_frame(stone);
    for (const auto& [name, form] :
         {std::pair("a.glb", GltfForm::binary), std::pair("a.gltf", GltfForm::text)}) {
        write_text(folder / name, gltf_bytes(stone, std::nullopt, form));
        const Solid back = load_solid(folder / name).solid;
        EXPECT_LT(test::plane_difference(stone.solid, back), 1e-6) << name;
    }
}

// JSON (RFC 8259, 8.1): who reads it may pass over a byte order mark.
TEST(Gltf, IsReadBehindAByteOrderMark) {
    const test::ScratchFolder folder;
    Stone stone;
    stone.solid = make_cut("emerald");
    write_text(folder / "a.gltf", "\xEF\xBB\xBF" + gltf_bytes(stone, std::nullopt, GltfForm::text));
    EXPECT_EQ(load_solid(folder / "a.gltf").solid.facets.size(), stone.solid.facets.size());
}

// Parts of a ZIP archive that is not compressed, found by its directory (PKWARE's APPNOTE).
std::map<std::string, std::string> parts_of(const std::string& zip) {
    const auto number = [&](std::size_t at, int size) {
        std::size_t value = 0;
        for (int i = size; i-- > 0;)
            value = 256 * value + static_cast<unsigned char>(zip.at(at + std::size_t(i)));
        return value;
    };
    std::map<std::string, std::string> parts;
    const std::size_t end = zip.size() - 22;
    EXPECT_EQ(number(end, 4), 0x06054b50u);
    std::size_t at = number(end + 16, 4);
    EXPECT_EQ(at + number(end + 12, 4), end);
    for (std::size_t i = 0; i < number(end + 10, 2); ++i) {
        EXPECT_EQ(number(at, 4), 0x02014b50u);
        const std::size_t size = number(at + 24, 4), name = number(at + 28, 2);
        const std::size_t local = number(at + 42, 4);
        EXPECT_EQ(number(local, 4), 0x04034b50u);
        for (const auto& [there, here] : {std::pair(14, 16), {18, 20}, {22, 24}})
            EXPECT_EQ(number(local + there, 4), number(at + here, 4));
        parts[zip.substr(at + 46, name)] = zip.substr(local + 30 + name, size);
        at += 46 + name;
    }
    return parts;
}

TEST(ThreeMf, IsAClosedBodyOfTheSameVolume) {
    const Solid solid = make_cut("pear");
    const auto parts = parts_of(three_mf_bytes(solid, "A <pear> & more"));
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_NE(parts.at("_rels/.rels").find("\"/3D/3dmodel.model\""), std::string::npos);
    const std::string& model = parts.at("3D/3dmodel.model");
    EXPECT_NE(model.find("unit=\"millimeter\""), std::string::npos);
    EXPECT_NE(model.find("A &lt;pear&gt; &amp; more"), std::string::npos);
    const std::regex vertex("<vertex x=\"([^\"]+)\" y=\"([^\"]+)\" z=\"([^\"]+)\""),
        triangle("<triangle v1=\"(\\d+)\" v2=\"(\\d+)\" v3=\"(\\d+)\"");
    std::vector<Vec3> corners;
    for (std::sregex_iterator i(model.begin(), model.end(), vertex), end; i != end; ++i)
        corners.push_back({std::stod((*i)[1]), std::stod((*i)[2]), std::stod((*i)[3])});
    EXPECT_EQ(corners, solid.vertices);
    double six_volumes = 0;
    for (std::sregex_iterator i(model.begin(), model.end(), triangle), end; i != end; ++i) {
        const auto at = [&](int k) { return corners.at(std::stoul((*i)[std::size_t(k)])); };
        six_volumes += glm::dot(at(1), glm::cross(at(2), at(3)));
    }
    EXPECT_NEAR(six_volumes / 6, volume(solid), 1e-12 * volume(solid));
    Solid open = solid;
    open.facets.pop_back();
    EXPECT_THROW(three_mf_bytes(open, ""), InputError);
}

TEST(Clearance, GrowsEveryPlane) {
    const Solid solid = make_cut("emerald"), seat = grown_outward(solid, 0.05);
    ASSERT_EQ(seat.facets.size(), solid.facets.size());
    for (const Facet& facet : seat.facets) {
        double most = -1e300;
        for (const Vec3& v : solid.vertices)
            most = std::max(most, glm::dot(facet.plane.normal, v) - facet.plane.offset);
        EXPECT_NEAR(most, -0.05, 1e-9) << facet.name;
    }
    EXPECT_THROW(grown_outward(solid, 0), InputError);
    EXPECT_THROW(grown_outward(solid, -1), InputError);
}

// A cut in any pose is exported with its girdle's plane at 0 and its table up.
TEST(ExportFrame, StandsOnTheGirdle) {
    Stone stone;
    stone.solid = make_cut("round-brilliant");
    for (Vec3& v : stone.solid.vertices) v = Vec3{v.z, v.x, v.y} + Vec3{3, 0, 0};
    for (Facet& f : stone.solid.facets) {
        const Vec3 n = f.plane.normal;
        f.plane.normal = {n.z, n.x, n.y};
        f.plane.offset += 3 * f.plane.normal.x;
    }
    stone.up_facet = "T";
    stone.unit = LengthUnit::cm;
    const Stone placed = in_export_frame(stone);
    EXPECT_EQ(placed.unit, LengthUnit::mm);
    const Facet& table = placed.solid.facets[std::size_t(find_facet(placed.solid, "T"))];
    EXPECT_NEAR(table.plane.normal.z, 1, 1e-12);
    double low = 0, high = 0;
    for (const Vec3& v : placed.solid.vertices) {
        low = std::min(low, v.z);
        high = std::max(high, v.z);
    }
    EXPECT_LT(low, 0);
    EXPECT_GT(high, 0);
    EXPECT_NEAR(volume(placed.solid), 1000 * volume(stone.solid), 1e-6 * volume(placed.solid));
}

}  // namespace
}  // namespace culet
