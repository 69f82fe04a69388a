// STEP files read by Open CASCADE, which shares nothing with the writer: one valid solid with the
// stone's volume and facet names. And culet's own reading, of its files and of such as Open CASCADE
// writes.

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <GProp_GProps.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <StepShape_AdvancedFace.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>
#include <TransferBRep.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <set>

#include "stone/cuts/cuts.h"
#include "stone/export/export_frame.h"
#include "stone/export/step.h"
#include "stone/solid_input.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "tests/scratch_folder.h"

namespace culet {
namespace {

int count_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
    int count = 0;
    for (TopExp_Explorer at(shape, kind); at.More(); at.Next()) ++count;
    return count;
}

double volume_of(const TopoDS_Shape& shape) {
    GProp_GProps properties;
    BRepGProp::VolumeProperties(shape, properties);
    return properties.Mass();
}

std::multiset<std::string> face_names(const STEPControl_Reader& reader, const TopoDS_Shape& shape) {
    std::multiset<std::string> names;
    const Handle(XSControl_TransferReader) transfer = reader.WS()->TransferReader();
    for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) {
        const auto face = Handle(StepShape_AdvancedFace)::DownCast(
            transfer->EntityFromShapeResult(at.Current(), 1));
        names.insert(face.IsNull() ? "?" : face->Name()->ToCString());
    }
    return names;
}

void expect_same_stone(const Solid& solid, const std::string& name) {
    const test::ScratchFolder folder;
    const std::string file = (folder / "stone.step").string();
    std::ofstream(file) << step_text(solid, name).text;
    STEPControl_Reader reader;
    ASSERT_EQ(reader.ReadFile(file.c_str()), IFSelect_RetDone);
    ASSERT_EQ(reader.TransferRoots(), 1);
    const TopoDS_Shape shape = reader.OneShape();
    EXPECT_EQ(count_of(shape, TopAbs_SOLID), 1);
    EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
    // Sums over its faces by Gauss's quadrature, in double precision.
    EXPECT_NEAR(volume_of(shape) / volume(solid), 1, 1e-9);
    std::multiset<std::string> names;
    for (const Facet& facet : solid.facets) names.insert(facet.name);
    EXPECT_EQ(face_names(reader, shape), names);
}

TEST(OpenCascade, ReadsEveryCut) {
    for (const CutKind& kind : cut_kinds()) {
        SCOPED_TRACE(kind.name);
        expect_same_stone(planar_solid(make_cut(kind.name), kind.convex, 1e-9), kind.name);
    }
}

TEST(OpenCascade, ReadsTheSeatOfASetting) {
    const Solid seat = grown_outward(make_cut("round-brilliant"), 0.05);
    expect_same_stone(planar_solid(seat, true, 1e-9), "seat");
}

TEST(OpenCascade, ReadsANameWithQuotesAndUmlauts) {
    Solid solid = make_cut("emerald");
    solid.facets[0].name = "T 'top'";
    expect_same_stone(solid, "Rubin 'grün'");
}

// Planes to 1e-9 of the width, and the names.
TEST(StepFiles, ComeBackAsStones) {
    const test::ScratchFolder folder;
    for (const CutKind& kind : cut_kinds()) {
        SCOPED_TRACE(kind.name);
        const Solid cut = planar_solid(make_cut(kind.name), kind.convex, 1e-9);
        std::ofstream(folder / "a.step") << step_text(cut, "stone").text;
        const Solid back = read_solid(folder / "a.step", Orientation::as_given).solid;
        const double width = width_along(cut, {1, 0, 0});
        ASSERT_EQ(back.facets.size(), cut.facets.size());
        for (const Facet& facet : cut.facets) {
            const int f = find_facet(back, facet.name);
            ASSERT_GE(f, 0) << facet.name;
            const Plane& plane = back.facets[std::size_t(f)].plane;
            EXPECT_LT(glm::length(plane.normal - facet.plane.normal), 1e-9) << facet.name;
            EXPECT_LT(std::abs(plane.offset - facet.plane.offset), 1e-9 * width) << facet.name;
        }
    }
}

std::string message_of(const std::filesystem::path& file) {
    try {
        load_solid(file);
    } catch (const InputError& error) {
        return error.what();
    }
    return "was read";
}

void write(const TopoDS_Shape& shape, const std::filesystem::path& file, const char* unit) {
    STEPControl_Writer writer;
    Interface_Static::SetCVal("write.step.unit", unit);
    writer.Transfer(shape, STEPControl_AsIs);
    writer.Write(file.c_str());
    Interface_Static::SetCVal("write.step.unit", "MM");
}

TEST(StepFiles, OfOtherProgramsAreReadInMillimetresOrRefused) {
    const test::ScratchFolder folder;
    const TopoDS_Shape box = BRepPrimAPI_MakeBox(3.0, 4.0, 5.0).Shape();
    for (const auto& [unit, mm] : {std::pair("MM", 1.0), {"INCH", 25.4}, {"M", 1000.0}}) {
        write(box, folder / "box.step", unit);
        // The writer leaves a model's numbers as they are, beside the unit's name.
        EXPECT_NE(read_text(folder / "box.step").find("(3.,4.,5.)"), std::string::npos) << unit;
        EXPECT_NEAR(volume(load_solid(folder / "box.step").solid) / std::pow(mm, 3), 60, 1e-9)
            << unit;
    }
    write(BRepPrimAPI_MakeCylinder(2.0, 3.0).Shape(), folder / "round.stp", "MM");
    EXPECT_NE(message_of(folder / "round.stp").find("is curved: a stone has plane facets"),
              std::string::npos)
        << message_of(folder / "round.stp");
    const TopoDS_Shape hollow =
        BRepAlgoAPI_Cut(box, BRepPrimAPI_MakeBox(gp_Pnt(1, 1, -1), 1.0, 1.0, 9.0).Shape()).Shape();
    write(hollow, folder / "hole.step", "MM");
    EXPECT_NE(message_of(folder / "hole.step").find("has a hole"), std::string::npos);
    std::ofstream(folder / "broken.step") << "ISO-10303-21;\nHEADER;\n";
    EXPECT_NE(message_of(folder / "broken.step").find("broken.step: "), std::string::npos);
    std::ofstream(folder / "text.step") << "nothing\n";
    EXPECT_NE(message_of(folder / "text.step"), "was read");
}

}  // namespace
}  // namespace culet
