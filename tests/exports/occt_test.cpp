// STEP files read by Open CASCADE, which shares nothing with the writer: one valid solid with the
// stone's volume and facet names.

#include <gtest/gtest.h>

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <STEPControl_Reader.hxx>
#include <StepShape_AdvancedFace.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>
#include <TransferBRep.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <fstream>
#include <set>

#include "stone/cuts/cuts.h"
#include "stone/export/export_frame.h"
#include "stone/export/step.h"
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

}  // namespace
}  // namespace culet
