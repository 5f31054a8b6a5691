// SPDX-License-Identifier: Apache-2.0
//
// A 3MF file is a zip archive; its relationships name the part with the model, whose XML is parsed while it is
// unpacked. A part becomes objects (a mesh or placed components) and the items that are built. Items are unfolded
// recursively with exact affine maps, from the unit of the model to millimetres, parts are read at the first use, and
// equal points are merged. `Unfolding` stops files whose components multiply beyond measure.
#include "nef/io/mesh/formats/threemf_mesh.h"

#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <sstream>
#include <tuple>

#include "nef/base/text/in_quotes.h"
#include "nef/geometry/vectors.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/formats/xml_events.h"
#include "nef/io/mesh/unfolding.h"
#include "nef/io/text_cursor.h"
#include "nef/io/zip_archive.h"
#include "nef/mesh/vertex_merger.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

constexpr const char* kProduction = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";

// The units that 3MF has, as fractions of a millimetre in lowest terms.
constexpr std::tuple<const char*, int, int> kUnits[] = {{"micron", 1, 1000},   {"millimeter", 1, 1},
                                                        {"centimeter", 10, 1}, {"inch", 127, 5},
                                                        {"foot", 1524, 5},     {"meter", 1000, 1}};

// An object that another one, or the build, places.
struct Use {
  std::string part;  // of the archive
  std::string id;
  AffineMap placement;
};

struct Object {
  bool counts = true;  // it is no support
  std::string name;    // else the id
  std::vector<Rational3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Use> components;
};

// One XML file of the archive.
struct ArchivePart {
  Rational unit = 1;  // in millimetres
  std::map<std::string, Object> objects;
  std::vector<Use> items;
};

class PartReader {
 public:
  PartReader(ZipArchive& archive, const std::string& path, const std::string& name)
      : name_(name),
        events_(
            path + ": " + name, [this](const XmlElement& e) { open(e); }, [this](const std::string& n) { close(n); }) {
    archive.read(name.starts_with("/") ? name.substr(1) : name,
                 [this](std::string_view piece) { events_.parse(piece); });
    events_.parse({}, true);
  }

  ArchivePart take() { return std::move(part_); }

 private:
  [[noreturn]] void fail(FileProblem problem, const std::string& what) const {
    throw FileError(problem, events_.place() + ": " + what);
  }

  const std::string& need(const XmlElement& element, std::string_view attribute) const {
    const std::string* value = element.find(attribute);
    if (value == nullptr) {
      fail(FileProblem::kSyntax, "<" + element.name + "> lacks the attribute '" + std::string(attribute) + "'");
    }
    return *value;
  }

  void open(const XmlElement& e) {
    if (e.name == "vertex" && object_ != nullptr) {
      Rational3& point = object_->vertices.emplace_back();
      point = {number(need(e, "x")), number(need(e, "y")), number(need(e, "z"))};
    } else if (e.name == "triangle" && object_ != nullptr) {
      object_->triangles.push_back({index(need(e, "v1")), index(need(e, "v2")), index(need(e, "v3"))});
    } else if (e.name == "object") {
      object_ = &part_.objects[need(e, "id")];
      *object_ = {};
      const std::string* name = e.find("name");
      object_->name = name != nullptr && !name->empty() ? *name : need(e, "id");
      const std::string* type = e.find("type");
      object_->counts = type == nullptr || *type == "model" || *type == "surface" || *type == "other";
    } else if (e.name == "component" && object_ != nullptr) {
      object_->components.push_back(use(e));
    } else if (e.name == "item") {
      part_.items.push_back(use(e));
    } else if (e.name == "model") {
      check_extensions(e);
      if (const std::string* unit = e.find("unit")) part_.unit = millimetres(*unit);
    }
  }

  Rational millimetres(const std::string& unit) const {
    for (const auto& [name, numerator, denominator] : kUnits) {
      if (unit == name) return {numerator, denominator};
    }
    fail(FileProblem::kSyntax,
         "there is no unit " + in_quotes(unit) + "; it must be micron, millimeter, centimeter, inch, foot or meter");
  }

  void close(const std::string& name) {
    if (name != "object" || object_ == nullptr) return;
    for (const auto& t : object_->triangles) {
      for (const std::uint32_t v : t) {
        if (v >= object_->vertices.size()) {
          fail(FileProblem::kBadIndex, "a triangle of the object that ends here names vertex " + std::to_string(v) +
                                           ", but there are " + std::to_string(object_->vertices.size()));
        }
      }
    }
    object_ = nullptr;
  }

  void check_extensions(const XmlElement& model) const {
    const std::string* required = model.find("requiredextensions");
    if (required == nullptr) return;
    std::istringstream words(*required);
    for (std::string prefix; words >> prefix;) {
      const std::string uri = events_.uri(prefix);
      if (uri == kProduction || uri == kThreemfMaterials) continue;
      fail(FileProblem::kUnsupported, "it needs the extension " + in_quotes(uri.empty() ? prefix : uri));
    }
  }

  Use use(const XmlElement& e) const {
    Use result{name_, need(e, "objectid"), AffineMap::identity()};
    if (const std::string* part = e.find(std::string(kProduction) + "|path")) result.part = *part;
    if (const std::string* text = e.find("transform")) {
      std::istringstream words(*text);
      std::string word;
      std::size_t count = 0;
      for (; words >> word; ++count) {
        // Four rows: where the unit vectors go, and the origin.
        const std::size_t row = count / 3;
        if (row < 3) result.placement.linear[count % 3][row] = number(word);
        if (row == 3) result.placement.translation[count % 3] = number(word);
      }
      if (count != 12) fail(FileProblem::kSyntax, "a transform has " + std::to_string(count) + " numbers, not 12");
    }
    return result;
  }

  Rational number(const std::string& text) const {
    Rational value;
    if (!parse_number(text, value)) fail(FileProblem::kNotANumber, in_quotes(text) + " is not a number");
    return value;
  }

  std::uint32_t index(const std::string& text) const {
    std::uint32_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end)
      fail(FileProblem::kBadIndex, in_quotes(text) + " is not an index of a vertex");
    return value;
  }

  std::string name_;
  ArchivePart part_;
  Object* object_ = nullptr;
  XmlEvents events_;
};

// Where the model is: the target of the one relationship of that type, or where most programs put it.
std::string model_part(ZipArchive& archive, const std::string& path) {
  std::string target;
  const std::string relations = "_rels/.rels";
  if (archive.contains(relations)) {
    XmlEvents events(
        path + ": " + relations,
        [&target](const XmlElement& e) {
          const std::string* type = e.find("Type");
          const std::string* to = e.find("Target");
          if (e.name == "Relationship" && type != nullptr && *type == kThreemfModelType && to != nullptr) target = *to;
        },
        [](const std::string&) {});
    archive.read(relations, [&events](std::string_view piece) { events.parse(piece); });
    events.parse({}, true);
  }
  if (target.empty()) target = "3D/3dmodel.model";
  return target.starts_with("/") ? target : "/" + target;
}

class ModelReader {
 public:
  ModelReader(std::string_view bytes, const std::string& path) : path_(path), archive_(bytes, path) {}

  Mesh read(MeshParts* parts) {
    const std::string root = model_part(archive_, path_);
    const ArchivePart& model = part(root);
    const AffineMap to_millimetres = AffineMap::scale({model.unit, model.unit, model.unit});
    for (const Use& item : model.items) place(item, to_millimetres, 0);
    if (parts != nullptr) *parts = std::move(placed_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(FileProblem problem, const std::string& what) const {
    throw FileError(problem, path_ + ": " + what);
  }

  const ArchivePart& part(const std::string& name) {
    const auto found = parts_.find(name);
    if (found != parts_.end()) return found->second;
    const ArchivePart& result = parts_.emplace(name, PartReader(archive_, path_, name).take()).first->second;
    for (const auto& [id, object] : result.objects) unfolding_.add_stored(items_in(object));
    return result;
  }

  static std::size_t items_in(const Object& object) { return object.vertices.size() + object.triangles.size(); }

  void place(const Use& use, const AffineMap& outer, int depth) {
    constexpr int kDeepest = 100;
    if (depth > kDeepest) fail(FileProblem::kUnsupported, "its components are nested too deeply");
    const ArchivePart& home = part(use.part.starts_with("/") ? use.part : "/" + use.part);
    const auto found = home.objects.find(use.id);
    if (found == home.objects.end()) {
      fail(FileProblem::kBadIndex, "there is no object " + in_quotes(use.id) + " in " + in_quotes(use.part));
    }
    const Object& object = found->second;
    if (!object.counts) return;
    unfolding_.add_placed(items_in(object));
    const AffineMap placement = outer.after(use.placement);
    const auto first = static_cast<std::uint32_t>(mesh_.face_count());
    add(object, placement);
    for (const Use& component : object.components) place(component, placement, depth + 1);
    placed_.push_back({object.name, first, static_cast<std::uint32_t>(mesh_.face_count())});
  }

  void add(const Object& object, const AffineMap& placement) {
    std::vector<std::uint32_t> vertex;
    vertex.reserve(object.vertices.size());
    for (const Rational3& point : object.vertices) vertex.push_back(merger_.add(placement(point)));
    const bool mirrors = placement.determinant() < 0;
    for (const auto& triangle : object.triangles) {
      std::array<std::uint32_t, 3> t{vertex[triangle[0]], vertex[triangle[1]], vertex[triangle[2]]};
      if (mirrors) std::swap(t[1], t[2]);
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh_.push_face(t);
    }
  }

  const std::string& path_;
  ZipArchive archive_;
  std::map<std::string, ArchivePart> parts_;  // by name with a slash in front
  Unfolding unfolding_{path_};
  Mesh mesh_;
  MeshParts placed_;
  VertexMerger merger_{mesh_.vertices};
};

}  // namespace

Mesh read_3mf(std::string_view bytes, const std::string& path, MeshParts* parts) {
  return ModelReader(bytes, path).read(parts);
}

}  // namespace nef
