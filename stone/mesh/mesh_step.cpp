// Reads STEP by Open CASCADE, where culet is built with it.

#include "stone/mesh/mesh_formats.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"

#ifdef CULET_OPEN_CASCADE
#include <fmt/format.h>

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <StepShape_AdvancedFace.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Wire.hxx>
#include <TransferBRep.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <map>
#include <sstream>
#endif

namespace culet {

bool is_step(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    return extension == "step" || extension == "stp";
}

#ifndef CULET_OPEN_CASCADE

FaceSoup read_step(const std::filesystem::path& file) {
    throw InputError(file,
                     "is STEP, which this culet cannot read: build it where Open CASCADE is "
                     "installed (Debian: libocct-data-exchange-dev), or convert the file to .obj "
                     "in your CAD program");
}

#else

namespace {

class StepFaces {
public:
    explicit StepFaces(const std::filesystem::path& file) : file_(file) {}

    FaceSoup read() {
        Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
        std::istringstream text(read_text(file_));
        if (reader_.ReadStream(file_.filename().string().c_str(), text) != IFSelect_RetDone)
            throw InputError(file_, "is not STEP that can be read");
        // In mm, whatever the file's unit.
        reader_.TransferRoots();
        const TopoDS_Shape shape = reader_.OneShape();
        if (shape.IsNull()) throw InputError(file_, "holds no shape");
        int solids = 0;
        for (TopExp_Explorer at(shape, TopAbs_SOLID); at.More(); at.Next()) ++solids;
        if (solids > 1)
            throw InputError(file_, fmt::format("holds {} solids: write the stone alone", solids));
        for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next())
            add(TopoDS::Face(at.Current()));
        if (soup_.faces.empty()) throw InputError(file_, "holds no face: a stone is a solid");
        return std::move(soup_);
    }

private:
    std::string name_of(const TopoDS_Face& face) const {
        const auto entity = Handle(StepShape_AdvancedFace)::DownCast(
            reader_.WS()->TransferReader()->EntityFromShapeResult(face, 1));
        return entity.IsNull() || entity->Name().IsNull() ? "" : entity->Name()->ToCString();
    }

    void add(const TopoDS_Face& face) {
        const std::string name = name_of(face);
        const auto refuse = [&](const char* what) {
            throw InputError(
                file_, fmt::format("face {} '{}' {}: a stone has plane facets with straight edges, "
                                   "so convert it to a mesh (.obj) in your CAD program",
                                   soup_.faces.size() + 1, shown(name), what));
        };
        if (BRepAdaptor_Surface(face).GetType() != GeomAbs_Plane) refuse("is curved");
        int wires = 0;
        for (TopExp_Explorer at(face, TopAbs_WIRE); at.More(); at.Next()) ++wires;
        if (wires != 1) refuse("has a hole");
        SoupFace& corners = soup_.faces.emplace_back();
        for (BRepTools_WireExplorer at(BRepTools::OuterWire(face), face); at.More(); at.Next()) {
            if (BRepAdaptor_Curve(at.Current()).GetType() != GeomAbs_Line)
                refuse("has a curved edge");
            corners.corners.push_back(vertex_of(at.CurrentVertex()));
        }
        const auto known = names_.try_emplace(name, int(soup_.names.size()));
        if (known.second && !name.empty()) soup_.names.push_back(name);
        if (!name.empty()) corners.name = known.first->second;
    }

    int vertex_of(const TopoDS_Vertex& vertex) {
        const int before = corners_.Extent(), index = corners_.Add(vertex) - 1;
        if (index == before) {
            const gp_Pnt at = BRep_Tool::Pnt(vertex);
            soup_.vertices.emplace_back(at.X(), at.Y(), at.Z());
            for (const double value : {at.X(), at.Y(), at.Z()}) soup_.precision.add_double(value);
        }
        return index;
    }

    const std::filesystem::path& file_;
    STEPControl_Reader reader_;
    TopTools_IndexedMapOfShape corners_;
    std::map<std::string, int> names_;
    FaceSoup soup_;
};

}  // namespace

FaceSoup read_step(const std::filesystem::path& file) {
    try {
        return StepFaces(file).read();
    } catch (const Standard_Failure& failure) {
        throw InputError(file, fmt::format("Open CASCADE cannot read it: {}",
                                           shown(failure.GetMessageString())));
    }
}

#endif

}  // namespace culet
