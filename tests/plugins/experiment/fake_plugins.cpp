#include "fake_plugins.hpp"

#include "tasks/table.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hauberk::test {

namespace {

/// A field with its two mandatory parts.
Field field(const char* name, Field::Kind kind)
{
  Field f;
  f.name = name;
  f.kind = kind;
  f.doc = "A field.";
  return f;
}

class Rings : public Shape {
 public:
  explicit Rings(const std::vector<std::string>& names) : names_(names)
  {
    for (const std::string& name : names) {
      ParameterInfo R{name + ".R", "length", std::numeric_limits<double>::quiet_NaN(), 0.0, 1e6,
                      "radius",    true};
      ParameterInfo r{name + ".r", "length", 0.5, 0.0, 1e6, "thickness", true};
      parameters_.push_back(R);
      parameters_.push_back(r);
    }
    parameters_.push_back({"count", "1", 1.0, 1.0, 9.0, "not smooth", false});
  }

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override
  {
    for (std::size_t k = 0; k < names_.size(); ++k) {
      if (p[2 * k + 1] >= p[2 * k]) throw InputError("ring '" + names_[k] + "' has no hole");
      Primitive ring;
      ring.name = names_[k];
      ring.size = {p[2 * k], p[2 * k + 1], p[2 * k + 1]};
      out.push_back(ring);
    }
  }
  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override
  {
    out.assign(names_.size(), PrimitiveJacobian(primitive_dofs * p.size(), 0.0));
  }

 private:
  std::vector<std::string> names_;
  std::vector<ParameterInfo> parameters_;
};

void rings_fields(std::vector<Field>& out)
{
  Field name = field("name", Field::Kind::string);
  name.required = true;
  Field ring = field("ring", Field::Kind::object);
  ring.children = {name};
  Field rings = field("rings", Field::Kind::list);
  rings.required = true;
  rings.min_items = 1;
  rings.children = {ring};
  out.push_back(rings);
}

std::unique_ptr<Shape> make_rings(const Node& section, Problems& problems)
{
  const std::size_t before = problems.list().size();
  std::vector<std::string> names;
  for (const Node& ring : section.at("rings").items) {
    names.push_back(ring.at("name").string);
    if (names.back() == "throw") throw std::runtime_error("out of rings");
    if (names.back() == "bad") problems.add(ring.at("name"), "no ring can be called 'bad'");
  }
  return problems.list().size() == before ? std::make_unique<Rings>(names) : nullptr;
}

/// A ring that is moved along x.
class Moved final : public Shape {
 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override
  {
    out.resize(1);
    out[0].position.x() = p[0];
    out[0].size = {5.0, 0.5, 0.5};
  }
  void do_jacobians(std::span<const double>, std::vector<PrimitiveJacobian>& out) const override
  {
    out = {{1.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
  }

 private:
  std::vector<ParameterInfo> parameters_{{"x", "length", 0.0, -9.0, 9.0, "", true}};
};

void position_field(std::vector<Field>& out) { out.push_back(field("position", Field::Kind::string)); }

std::unique_ptr<Shape> make_moved(const Node&, Problems&) { return std::make_unique<Moved>(); }

class Plane : public LoadCase {
 public:
  Plane(std::string measure, bool bends) : measure_(std::move(measure)), bends_(bends) {}

 protected:
  const std::vector<MacroInfo>& do_macros() const override { return macros_; }
  int do_coordinate_count() const override { return 2; }
  int do_lattice_vectors() const override { return bends_ ? 0 : 2; }
  void do_position(std::span<const double>, std::span<const double>, const Vec3& X, const Vec3& T,
                   PositionMap& out) const override
  {
    out.x = X + T;
  }
  bool do_admissible(std::span<const double>) const override { return true; }
  std::pair<double, double> do_stretch_range(std::span<const double>) const override { return {1.0, 1.0}; }
  void do_load(double, std::span<double> t) const override { t[0] = 1.0; }
  double do_value(double, std::span<const double> macro) const override { return macro[0]; }
  std::string do_measure() const override { return measure_; }
  int do_value_length_power() const override { return bends_ ? -1 : 0; }
  std::pair<std::string, std::string> do_sense_names() const override
  {
    return bends_ ? std::make_pair("up", "down") : std::make_pair("stretch", "compress");
  }
  void do_metric(std::span<double> m) const override { m[0] = 1.0; }
  Boundedness do_boundedness(std::span<const double>, std::span<const Vec3>) const override
  {
    return Boundedness::attained;
  }

 private:
  std::string measure_;
  bool bends_;
  std::vector<MacroInfo> macros_{{"e", 0}};
};

void plane_fields(std::vector<Field>& out)
{
  Field measure = field("measure", Field::Kind::choice);
  measure.choices = {"tensor", "paper"};
  measure.default_json = "\"tensor\"";
  out.push_back(measure);
}

std::unique_ptr<LoadCase> make_plane(const Node& section, double length, Problems&)
{
  if (!(length > 0.0)) throw std::runtime_error("no length");
  return std::make_unique<Plane>(section.at("measure").string, false);
}

/// A plane with the three unknowns of a strain.
class Strains final : public Plane {
 public:
  Strains() : Plane("tensor", false) {}

 protected:
  const std::vector<MacroInfo>& do_macros() const override { return macros_; }
  void do_metric(std::span<double> m) const override
  {
    m[0] = m[1] = 1.0;
    m[2] = 2.0;
  }

 private:
  std::vector<MacroInfo> macros_{{"exx", 0}, {"eyy", 0}, {"exy", 0}};
};

std::unique_ptr<LoadCase> make_strains(const Node&, double, Problems&) { return std::make_unique<Strains>(); }

std::unique_ptr<LoadCase> make_bend(const Node&, double, Problems&)
{
  return std::make_unique<Plane>("normal_curvature", true);
}

class Search : public Optimizer {
 protected:
  OptimizerResult do_minimize(OptimizationProblem&, std::span<const double> start,
                              OptimizerObserver&) const override
  {
    OptimizerResult result;
    result.x.assign(start.begin(), start.end());
    return result;
  }
};

void search_fields(std::vector<Field>& out)
{
  Field steps = field("steps", Field::Kind::integer);
  steps.default_json = "40";
  steps.minimum = 1.0;
  out.push_back(steps);
}

std::unique_ptr<Optimizer> make_search(const Node&, Problems&) { return std::make_unique<Search>(); }

void no_fields(std::vector<Field>&) {}

const PluginTable rings = {HAUBERK_HANDSHAKE, PluginKind::shape, "rings", "1",    "Rings.", "none",
                           rings_fields,      make_rings,        nullptr, nullptr};
const PluginTable moved = {HAUBERK_HANDSHAKE, PluginKind::shape, "moved", "1",    "A ring.", "none",
                           no_fields,         make_moved,        nullptr, nullptr};
const PluginTable placed = {HAUBERK_HANDSHAKE, PluginKind::shape, "placed", "1",    "A ring.", "none",
                            position_field,    make_moved,        nullptr,  nullptr};
const PluginTable plane = {HAUBERK_HANDSHAKE, PluginKind::load_case,
                           "plane",           "1",
                           "A plane.",        "none",
                           plane_fields,      nullptr,
                           make_plane,        nullptr};
const PluginTable bend = {HAUBERK_HANDSHAKE,
                          PluginKind::load_case,
                          "bend",
                          "1",
                          "A bend.",
                          "none",
                          no_fields,
                          nullptr,
                          make_bend,
                          nullptr};
const PluginTable strains = {
    HAUBERK_HANDSHAKE, PluginKind::load_case, "strains", "1", "Three strains.", "none", no_fields,
    nullptr,           make_strains,          nullptr};
const PluginTable search = {HAUBERK_HANDSHAKE, PluginKind::optimizer,
                            "search",          "1",
                            "A search.",       "none",
                            search_fields,     nullptr,
                            nullptr,           make_search};

}  // namespace

const PluginTable* fake_lookup(PluginKind kind, const std::string& id, std::string& error)
{
  for (const PluginTable* table : {&rings, &moved, &placed, &plane, &strains, &bend, &search}) {
    if (table->kind == kind && id == table->id) return table;
  }
  error = "no plugin '" + id + "' here";
  return nullptr;
}

std::string valid_text()
{
  return R"({
  "name": "pair",
  "elements": {
    "link": { "shape": "rings", "rings": [ { "name": "ring" } ],
      "parameters": { "ring.R": 5.0, "ring.r": 0.7 } },
  },
  "cell": {
    "vectors": [[12, 0], [0, 100]],
    "place": [
      { "element": "link", "position": [0, 0, 0] },
      { "element": "link", "position": [6, 0, 0], "rotation": { "axis": [1, 0, 0], "degrees": 90 } },
    ] },
  "load_case": { "plugin": "plane", "directions_deg": [0, 30] }, // a comment
  "solver": { "tolerance": 1e-3 },
  "design": {
    "optimizer": { "plugin": "search" }, "quantity": "eta",
    "variables": [ { "parameters": "ring.R", "lower": 4.0, "upper": 6.5 } ],
    "targets": [ { "direction_deg": 0, "value": 0.05 } ],
  },
}
)";
}

std::string with(std::string text, const std::string& from, const std::string& to)
{
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "'" << from << "' is not in the text";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string problems_of(const std::string& text, const std::vector<std::string>& overrides)
{
  Diagnostics diagnostics;
  const std::optional<Experiment> experiment =
      read_experiment({"t.json", text, overrides, {}, {}, task_formats()}, fake_lookup, diagnostics);
  EXPECT_EQ(experiment.has_value(), diagnostics.empty());
  return diagnostics.text();
}

Experiment read_ok(const std::string& text, const std::vector<std::string>& overrides)
{
  Diagnostics diagnostics;
  std::optional<Experiment> experiment =
      read_experiment({"t.json", text, overrides, {}, {}, task_formats()}, fake_lookup, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  if (!experiment) throw std::runtime_error("no experiment");
  return std::move(*experiment);
}

}  // namespace hauberk::test
