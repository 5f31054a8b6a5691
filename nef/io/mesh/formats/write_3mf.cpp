// SPDX-License-Identifier: Apache-2.0
//
// The model is one object: vertices, triangles and, by the extension of 3MF for materials, colours of its vertices or
// places in an image, which the archive contains. A triangle names its three of them.
#include <array>

#include "nef/geometry/vectors.h"
#include "nef/io/mesh/formats/threemf_mesh.h"
#include "nef/io/number_text.h"
#include "nef/io/zip_archive.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

constexpr const char* kXml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
constexpr const char* kImage = "/3D/Textures/texture.png";

// An attribute of an element.
template <typename Number>
void append_attribute(std::string& text, std::string_view name, Number value) {
  text += ' ';
  text += name;
  text += "=\"";
  append_number(text, value);
  text += '"';
}

/// What the corners of triangles look like: a list of colours, or of places in the image.
class Looks {
 public:
  Looks(const Mesh& mesh, const MeshWriteOptions& options) : mesh_(mesh), options_(options) {
    if (textured()) places_ = textured_vertices(mesh, options.texture);
  }

  [[nodiscard]] bool textured() const { return !options_.texture.none(); }
  [[nodiscard]] bool any() const { return textured() || !options_.vertex_colors.empty(); }

  // The resources: 2 is the list, 3 the image.
  void append_resources(std::string& model) const {
    if (textured()) {
      model += std::string("  <m:texture2d id=\"3\" path=\"") + kImage + "\" contenttype=\"image/png\"/>\n";
      model += "  <m:texture2dgroup id=\"2\" texid=\"3\">\n";
      for (const auto& [u, v] : places_.places) {
        model += "   <m:tex2coord";
        append_attribute(model, "u", u);
        append_attribute(model, "v", v);
        model += "/>\n";
      }
      model += "  </m:texture2dgroup>\n";
    } else if (any()) {
      model += "  <m:colorgroup id=\"2\">\n";
      for (const auto& color : options_.vertex_colors) {
        constexpr const char* kDigits = "0123456789ABCDEF";
        model += "   <m:color color=\"#";
        for (const std::uint8_t c : color) {
          model += kDigits[c / 16];
          model += kDigits[c % 16];
        }
        model += "\"/>\n";
      }
      model += "  </m:colorgroup>\n";
    }
  }

  // What the corners of a triangle, which is one of a face, name in the list.
  void append_corners(std::string& model, std::uint32_t face, const std::array<std::uint32_t, 3>& corners) const {
    if (!any()) return;
    model += " pid=\"2\"";
    constexpr std::array<std::string_view, 3> kNames{"p1", "p2", "p3"};
    for (std::size_t i = 0; i < 3; ++i) {
      append_attribute(model, kNames[i], textured() ? places_.corners[corner_at(face, corners[i])] : corners[i]);
    }
  }

 private:
  // Textured faces are triangles, so a vertex is at one of their corners.
  [[nodiscard]] std::uint32_t corner_at(std::uint32_t face, std::uint32_t vertex) const {
    std::uint32_t c = mesh_.face_begin[face];
    while (mesh_.corners[c] != vertex) ++c;
    return c;
  }

  const Mesh& mesh_;
  const MeshWriteOptions& options_;
  TexturedVertices places_;
};

void append_mesh(std::string& model, const Mesh& mesh, const MeshSurface& surface, const Looks& looks) {
  model += looks.any() ? "  <object id=\"1\" type=\"model\" pid=\"2\" pindex=\"0\"><mesh>\n   <vertices>\n"
                       : "  <object id=\"1\" type=\"model\"><mesh>\n   <vertices>\n";
  for (const Rational3& point : mesh.vertices) {
    model += "    <vertex";
    append_attribute(model, "x", nearest_double(point[0]));
    append_attribute(model, "y", nearest_double(point[1]));
    append_attribute(model, "z", nearest_double(point[2]));
    model += "/>\n";
  }
  model += "   </vertices>\n   <triangles>\n";
  for (std::uint32_t k = 0; k < surface.triangles.size(); ++k) {
    const std::array<std::uint32_t, 3> t = surface.corners_in_face(mesh, k);
    model += "    <triangle";
    append_attribute(model, "v1", t[0]);
    append_attribute(model, "v2", t[1]);
    append_attribute(model, "v3", t[2]);
    looks.append_corners(model, surface.face_of[k], t);
    model += "/>\n";
  }
  model += "   </triangles>\n  </mesh></object>\n";
}

std::string model_text(const Mesh& mesh, const MeshSurface& surface, const Looks& looks, const Rational3& offset) {
  std::string model = kXml;
  model += std::string("<model unit=\"millimeter\" xml:lang=\"en\" xmlns=\"") + kThreemfCore + '"';
  if (looks.any()) model += std::string(" xmlns:m=\"") + kThreemfMaterials + '"';
  model += ">\n <metadata name=\"Application\">nef</metadata>\n <resources>\n";
  if (!surface.triangles.empty()) {
    looks.append_resources(model);
    append_mesh(model, mesh, surface, looks);
  }
  model += " </resources>\n <build>";
  if (!surface.triangles.empty()) {
    model += "<item objectid=\"1\"";
    if (!is_zero(offset)) {
      model += " transform=\"1 0 0 0 1 0 0 0 1";
      for (const Rational& x : offset) {
        model += ' ';
        append_number(model, nearest_double(x));
      }
      model += '"';
    }
    model += "/>";
  }
  return model + "</build>\n</model>\n";
}

std::string relationships(std::string_view target, std::string_view id, std::string_view type) {
  std::string text = kXml;
  text += "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n";
  text.append(" <Relationship Target=\"").append(target).append("\" Id=\"").append(id).append("\" Type=\"");
  return text.append(type).append("\"/>\n</Relationships>\n");
}

std::string content_types(bool image) {
  std::string text = kXml;
  text +=
      "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
      " <Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
      " <Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n";
  if (image) text += " <Default Extension=\"png\" ContentType=\"image/png\"/>\n";
  return text + "</Types>\n";
}

}  // namespace

std::string threemf_bytes(const Mesh& mesh, const MeshWriteOptions& options) {
  constexpr const char* kTextureType = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dtexture";
  const MeshSurface surface(mesh, options.monitor);
  const Looks looks(mesh, options);
  const bool image = looks.textured() && !surface.triangles.empty();
  std::vector<std::pair<std::string, std::string>> files{
      {"[Content_Types].xml", content_types(image)},
      {"_rels/.rels", relationships("/3D/3dmodel.model", "rel0", kThreemfModelType)},
      {"3D/3dmodel.model", model_text(mesh, surface, looks, options.offset)}};
  if (image) {
    files.push_back({"3D/_rels/3dmodel.model.rels", relationships(kImage, "rel1", kTextureType)});
    files.push_back({std::string(kImage + 1), options.texture.png});
  }
  return zip_bytes(files);
}

}  // namespace nef
