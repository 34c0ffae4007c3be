#include <tinyxml2.h>

#include <beeline/error.h>
#include <beeline/io/text/internal/mesh_hull.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/urdf_collision.h>
#include <beeline/io/text/internal/urdf_origin.h>
#include <beeline/io/text/internal/xml.h>

namespace beeline::internal {
namespace {

using tinyxml2::XMLElement;

/// A size, whose attribute must be there.
double needed_size(const XmlElements& elements, const XMLElement& body, const char* attribute) {
  elements.needed_text(body, attribute);
  return elements.number_or(body, attribute, 0);
}

/// Reads a mesh as its hull. Throws FileError that names the line, or the mesh's own file.
Shape mesh_shape(const XmlElements& elements, const std::string& link, const XMLElement& mesh,
                 MeshHulls& meshes) {
  const std::string filename = elements.needed_text(mesh, "filename");
  try {
    return meshes.read(filename, elements.vector(mesh, "scale", Vector3::Ones()));
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    elements.refuse(mesh.GetLineNum(), "link " + link + ": " + error.what());
  }
}

/// Reads the body of a shape. Throws XmlError, and FileError for a kind that is not read.
void read_body(const XmlElements& elements, const std::string& link, const XMLElement& body,
               MeshHulls& meshes, Shape& shape) {
  const std::string_view kind = body.Name();
  if (kind == "box") {
    elements.needed_text(body, "size");
    shape.body = Box{elements.vector(body, "size", Vector3::Zero())};
  } else if (kind == "cylinder") {
    shape.body =
        Cylinder{needed_size(elements, body, "radius"), needed_size(elements, body, "length")};
  } else if (kind == "sphere") {
    shape.body = Sphere{needed_size(elements, body, "radius")};
  } else if (kind == "capsule") {
    shape.body =
        Capsule{needed_size(elements, body, "radius"), needed_size(elements, body, "length")};
  } else if (kind == "mesh") {
    shape = mesh_shape(elements, link, body, meshes);
  } else {
    elements.refuse(
        body.GetLineNum(),
        "link " + link + " has " + described(body) +
            " as collision geometry, which is not read; known are <box>, <cylinder>, "
            "<sphere>, <capsule> and <mesh>; replace it by these, or describe the arm in an arm "
            "file with \"shapes\"");
  }
}

/// Refuses an element beside another one that URDF has once: one of them would be lost.
void refuse_second(const XmlElements& elements, const std::string& link, const XMLElement* second,
                   const std::string& what) {
  if (second == nullptr) return;
  elements.refuse(second->GetLineNum(), "link " + link + " has " + described(*second) +
                                            ", a second " + what +
                                            "; give each its own <collision>");
}

Shape collision_shape(const XmlElements& elements, const std::string& link,
                      const XMLElement& collision, MeshHulls& meshes) {
  const XMLElement* const geometry = collision.FirstChildElement("geometry");
  const XMLElement* const body = geometry == nullptr ? nullptr : geometry->FirstChildElement();
  const XMLElement* const origin = collision.FirstChildElement("origin");
  for (const XMLElement* const first : {geometry, origin}) {
    if (first == nullptr) continue;
    refuse_second(elements, link, first->NextSiblingElement(first->Name()),
                  "element of this name in a <collision>");
  }
  if (body != nullptr) {
    refuse_second(elements, link, body->NextSiblingElement(), "body in a <geometry>");
  }
  if (body == nullptr) {
    elements.refuse(collision.GetLineNum(), "link " + link + " has a <collision> without geometry");
  }
  Shape shape;
  read_body(elements, link, *body, meshes, shape);
  shape.pose = read_origin(elements, collision).pose;
  try {
    check_shape(shape);
  } catch (const Error& error) {
    elements.refuse(body->GetLineNum(), "the <collision> of link " + link + ": " + error.what());
  }
  return shape;
}

}  // namespace

UrdfShapes collision_shapes(std::string_view text, const std::string& path,
                            const std::map<std::string, std::string>& package) {
  const XmlElements elements(path);
  MeshHulls meshes(path, package);
  tinyxml2::XMLDocument document;
  parse_xml(document, text, path);
  UrdfShapes shapes;
  const XMLElement* const robot = document.RootElement();
  if (robot == nullptr) return shapes;
  for (const XMLElement* at = robot->FirstChildElement("link"); at != nullptr;
       at = at->NextSiblingElement("link")) {
    const char* const name = at->Attribute("name");
    if (name == nullptr) continue;
    const std::string link = with_escaped_bytes(name);
    for (const XMLElement* collision = at->FirstChildElement("collision"); collision != nullptr;
         collision = collision->NextSiblingElement("collision")) {
      shapes.of_link[link].push_back(collision_shape(elements, link, *collision, meshes));
    }
    const bool is_visible = at->FirstChildElement("visual") != nullptr;
    if (is_visible && !shapes.of_link.contains(link)) shapes.only_visual.push_back(link);
  }
  return shapes;
}

}  // namespace beeline::internal
