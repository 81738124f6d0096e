#include "inspect/model_file.hpp"

#include "archive/archive.hpp"
#include "common/mesh_file.hpp"
#include "common/text_file.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#ifdef HAUBERK_EXPAT
#include <expat.h>
#endif

#include <charconv>
#include <map>
#include <memory>
#include <optional>

namespace hauberk::inspecting {

namespace {
#ifdef HAUBERK_EXPAT

/// Components of components of ... : an object that holds itself never ends.
constexpr int deepest = 16;
constexpr std::size_t most_placed = 100000;

/// x -> A x + b.
struct Placement {
  Mat3 A = Mat3::Identity();
  Vec3 b = Vec3::Zero();

  Placement after(const Placement& first) const { return {A * first.A, A * first.b + b}; }
};

struct Placed {
  std::string object;
  Placement placement;
  std::string name;  ///< of an item; may be empty
};

struct Object {
  std::string name;
  MeshFile mesh;
  std::vector<Part> parts;  ///< of the mesh, made when it is first placed
  std::vector<Placed> components;
};

/// The name of an element of the core of 3MF, or of one without a namespace; empty: of an extension.
std::string_view local(std::string_view name)
{
  constexpr std::string_view core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
  const std::size_t bar = name.rfind('|');
  if (bar == std::string_view::npos) return name;
  return name.substr(0, bar) == core ? name.substr(bar + 1) : std::string_view();
}

/// The name of an attribute without its namespace.
std::string_view attribute_name(std::string_view name)
{
  const std::size_t bar = name.rfind('|');
  return bar == std::string_view::npos ? name : name.substr(bar + 1);
}

/// The document 3D/3dmodel.model, as far as shapes go, while it is read.
class Model {
 public:
  explicit Model(const std::string& name) : name_(name) {}

  void read(std::string_view text)
  {
    const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreate(nullptr),
                                                                         &XML_ParserFree);
    parser_ = parser.get();
    XML_SetUserData(parser_, this);
    XML_SetStartElementHandler(parser_, [](void* self, const char* tag, const char** attributes) {
      auto* model = static_cast<Model*>(self);
      if (model->problem_) return;
      try {
        model->begin(local(tag), attributes);
      } catch (const InputError& error) {  // nothing may be thrown through a library of C
        model->stop(error);
      }
    });
    XML_SetEndElementHandler(parser_, [](void* self, const char* tag) {
      if (local(tag) == "object") static_cast<Model*>(self)->object_ = nullptr;
    });
    // Entities have no place in such a file, and can make it endless.
    XML_SetEntityDeclHandler(parser_, [](void* self, const char*, int, const char*, int, const char*,
                                         const char*, const char*, const char*) {
      auto* model = static_cast<Model*>(self);
      model->stop(InputError(model->place() + "declares an entity, which 3MF has not"));
    });
    constexpr std::size_t piece = 1 << 20;
    for (std::size_t at = 0; at < text.size() && !problem_; at += piece) {
      const std::size_t size = std::min(piece, text.size() - at);
      if (XML_Parse(parser_, text.data() + at, static_cast<int>(size), at + size == text.size() ? 1 : 0) ==
              XML_STATUS_ERROR &&
          !problem_)
        throw InputError(place() + XML_ErrorString(XML_GetErrorCode(parser_)));
    }
    if (problem_) throw InputError(*problem_);
  }

  ModelFile result()
  {
    ModelFile out;
    out.unit = unit_;
    out.objects = 0;
    for (const Placed& item : items_) place_object(item, {}, 0, out);
    return out;
  }

 private:
  using Attributes = std::map<std::string, std::string, std::less<>>;

  void stop(const InputError& error)
  {
    problem_ = error.what();
    XML_StopParser(parser_, XML_FALSE);
  }

  std::string place() const
  {
    return fmt::format("{}: 3D model, line {}: ", name_,
                       static_cast<long>(XML_GetCurrentLineNumber(parser_)));
  }

  [[noreturn]] void refuse(const std::string& what) const { throw InputError(place() + what); }

  const std::string& attribute(const Attributes& attributes, const char* key) const
  {
    const auto found = attributes.find(key);
    if (found == attributes.end()) refuse(fmt::format("expected {}=", key));
    return found->second;
  }

  double number(const std::string& text) const
  {
    double x = 0.0;
    if (!detail::read_number(text, x)) refuse("expected a number, found " + detail::quoted(text));
    return x;
  }

  int index(const Attributes& attributes, const char* key) const
  {
    const std::string& text = attribute(attributes, key);
    int k = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), k);
    if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || k < 0)
      refuse(fmt::format("expected the number of a point in {}=, found {}", key, detail::quoted(text)));
    return k;
  }

  /// Twelve numbers, by columns of A and then b.
  Placement placement(const Attributes& attributes) const
  {
    Placement out;
    const auto found = attributes.find("transform");
    if (found == attributes.end()) return out;
    std::string_view rest = found->second;
    for (int k = 0; k < 12; ++k) {
      const std::string_view word = detail::next_word(rest);
      if (word.empty()) refuse("expected 12 numbers in transform=");
      const double x = number(std::string(word));
      if (k < 9)
        out.A(k % 3, k / 3) = x;
      else
        out.b[k - 9] = x;
    }
    return out;
  }

  Object& open() const
  {
    if (object_ == nullptr) refuse("expected an object around this");
    return *object_;
  }

  void begin(std::string_view tag, const char** pairs)
  {
    Attributes attributes;
    for (; *pairs != nullptr; pairs += 2) attributes[std::string(attribute_name(pairs[0]))] = pairs[1];
    if (tag == "model") {
      const auto unit = attributes.find("unit");
      const std::string named = unit == attributes.end() ? "millimeter" : unit->second;
      unit_ = named == "millimeter" ? "mm"
              : named == "meter"    ? "m"
              : named == "micron"   ? "um"
              : named == "inch"     ? "in"
                                    : named;
    } else if (tag == "object") {
      object_ = &objects_[attribute(attributes, "id")];
      const auto name = attributes.find("name");
      if (name != attributes.end()) object_->name = name->second;
    } else if (tag == "vertex") {
      open().mesh.points.emplace_back(number(attribute(attributes, "x")), number(attribute(attributes, "y")),
                                      number(attribute(attributes, "z")));
    } else if (tag == "triangle") {
      MeshFile& mesh = open().mesh;
      std::array<int, 3> t{};
      std::size_t k = 0;
      for (const char* key : {"v1", "v2", "v3"}) {
        t[k] = index(attributes, key);
        if (static_cast<std::size_t>(t[k]) >= mesh.points.size())
          refuse(fmt::format("the object has {} points, and none of number {}", mesh.points.size(), t[k]));
        ++k;
      }
      mesh.triangles.push_back(t);
      if (++triangles_ > most_triangles) refuse(fmt::format("more than {} triangles", most_triangles));
    } else if (tag == "component") {
      if (attributes.contains("path")) refuse("objects in other files of the archive are not read");
      open().components.push_back({attribute(attributes, "objectid"), placement(attributes), ""});
    } else if (tag == "item") {
      if (attributes.contains("path")) refuse("objects in other files of the archive are not read");
      const auto name = attributes.find("partnumber");
      items_.push_back({attribute(attributes, "objectid"), placement(attributes),
                        name == attributes.end() ? std::string() : name->second});
    }
  }

  void place_object(const Placed& what, const Placement& outer, int depth, ModelFile& out)
  {
    const auto found = objects_.find(what.object);
    if (found == objects_.end())
      throw InputError(fmt::format("{}: there is no object {}", name_, what.object));
    if (depth > deepest)
      throw InputError(
          fmt::format("{}: object {} has components of components more than {} deep; does one hold itself?",
                      name_, what.object, deepest));
    if (++placed_ > most_placed)
      throw InputError(fmt::format("{}: places more than {} objects", name_, most_placed));
    Object& object = found->second;
    const Placement placement = outer.after(what.placement);
    if (!object.mesh.triangles.empty()) {
      detail::join_equal_points(object.mesh);
      append_parts({object.name, std::move(object.mesh.points), std::move(object.mesh.triangles)},
                   object.parts);
      object.mesh = {};
    }
    if (!object.parts.empty()) ++out.objects;
    for (const Part& own : object.parts) {
      placed_triangles_ += own.triangles.size();
      if (placed_triangles_ > most_triangles)
        throw InputError(fmt::format("{}: its items have more than {} triangles", name_, most_triangles));
      Part& part = out.parts.emplace_back(own);
      part.object = out.objects - 1;
      if (!what.name.empty()) part.name = what.name;
      for (Vec3& x : part.points) x = placement.A * x + placement.b;
      if (placement.A.determinant() < 0.0)
        for (auto& t : part.triangles) std::swap(t[1], t[2]);
    }
    for (Placed component : object.components) {
      component.name = what.name;
      place_object(component, placement, depth + 1, out);
    }
  }

  const std::string& name_;
  XML_Parser parser_ = nullptr;
  std::optional<std::string> problem_;
  std::string unit_ = "mm";
  std::map<std::string, Object> objects_;
  Object* object_ = nullptr;
  std::vector<Placed> items_;
  std::size_t triangles_ = 0, placed_ = 0, placed_triangles_ = 0;
};

/// A file of the archive, as far as it is not larger than what is read.
std::string unpacked(std::string_view bytes, const std::string& file, const std::string& name)
{
  archives::Content content = archives::unpack(bytes, file, std::size_t{most_megabytes} << 20);
  switch (content.result) {
    case archives::Unpacked::done:
      break;
    case archives::Unpacked::no_archive:
      throw InputError(
          fmt::format("{}: cannot be opened as the archive that 3MF is: {}", name, content.text));
    case archives::Unpacked::no_such_file:
      throw InputError(fmt::format("{}: holds no {}; is it a 3MF file?", name, file));
    case archives::Unpacked::too_large:
      throw InputError(fmt::format("{}: its {} is larger than {} MB", name, file, most_megabytes));
    case archives::Unpacked::not_readable:
      throw InputError(fmt::format("{}: {} cannot be unpacked: {}", name, file, content.text));
    case archives::Unpacked::damaged:
      throw InputError(fmt::format("{}: {} is damaged, or cut short", name, file));
  }
  return std::move(content.text);
}

#endif
}  // namespace

ModelFile read_three_mf([[maybe_unused]] std::string_view bytes, const std::string& name)
{
#ifdef HAUBERK_EXPAT
  if (archives::available()) {
    Model model(name);
    model.read(unpacked(bytes, "3D/3dmodel.model", name));
    return model.result();
  }
#endif
  throw InputError(fmt::format(
      "{}: this program was built without libzip and expat, and reads no 3MF; install libzip-dev and libexpat1-dev "
      "and build it again, or give .stl or .obj",
      name));
}

}  // namespace hauberk::inspecting
