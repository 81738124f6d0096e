#include "closed_tube.hpp"

#include <hauberk/kit/fields.hpp>

#include <limits>
#include <numeric>
#include <string>

namespace hauberk {
namespace {

constexpr double smallest_length = 1e-12;
constexpr double largest_length = 1e12;
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr int most_harmonics = 32;
constexpr double most_turns = 16.0;

/// Parameters and terms of a family of curves.
struct Family {
  std::vector<ParameterInfo> parameters;
  std::vector<CurveTerm> terms;

  /// A length above zero that every experiment gives.
  std::size_t size(const std::string& name, const char* doc) { return add(name, none, smallest_length, doc); }
  /// A length of any sign.
  std::size_t add(const std::string& name, double value, double lower, const char* doc)
  {
    parameters.push_back({name, "length", value, lower, largest_length, doc, true});
    return parameters.size() - 1;
  }
  void cosine(int k, int axis, std::size_t parameter, double weight)
  {
    terms.push_back({k, false, axis, parameter, weight});
  }
  void sine(int k, int axis, std::size_t parameter, double weight)
  {
    terms.push_back({k, true, axis, parameter, weight});
  }
};

/// x = a cos u, y = b sin u.
Family oval()
{
  Family f;
  f.cosine(1, 0, f.size("half_length", "half of the core's extent along x"), 1.0);
  f.sine(1, 1, f.size("half_width", "half of the core's extent along y"), 1.0);
  return f;
}

/// x = a cos u, y = b (9 sin u + sin 3 u)/8: straight where it is widest, as y'' = 0 there, and blunt at its
/// ends, where it bends with a radius of 9 b^2/(4 a).
Family racetrack()
{
  Family f;
  f.cosine(1, 0, f.size("half_length", "half of the core's extent along x"), 1.0);
  const std::size_t b = f.size("half_width", "half of the core's extent along y");
  f.sine(1, 1, b, 9.0 / 8.0);
  f.sine(3, 1, b, 1.0 / 8.0);
  return f;
}

/// x = R cos u + c cos (n - 1) u, y = R sin u - c sin (n - 1) u: a corner on the x axis for c > 0, straight
/// sides for c = R/(n - 1)^2.
Family polygon(int corners)
{
  Family f;
  const std::size_t R = f.size("R", "mean radius of the core");
  const std::size_t c = f.add("corner", 0.0, -largest_length, "how far corners stand out beyond R");
  f.cosine(1, 0, R, 1.0);
  f.sine(1, 1, R, 1.0);
  f.cosine(corners - 1, 0, c, 1.0);
  f.sine(corners - 1, 1, c, -1.0);
  return f;
}

/// ((R + a cos q u) cos p u, (R + a cos q u) sin p u, b sin q u), as sums of cosines and sines.
Family knot(int p, int q)
{
  Family f;
  const std::size_t R = f.size("R", "radius of the circle that the core winds along");
  const std::size_t a = f.size("a", "how far it winds around that circle, towards the axis and away");
  const std::size_t b = f.size("b", "how far it winds up and down");
  f.cosine(p, 0, R, 1.0);
  f.sine(p, 1, R, 1.0);
  f.cosine(q + p, 0, a, 0.5);
  f.sine(q + p, 1, a, 0.5);
  const int slow = q > p ? q - p : p - q;
  f.cosine(slow, 0, a, 0.5);
  f.sine(slow, 1, a, q > p ? -0.5 : 0.5);
  f.sine(q, 2, b, 1.0);
  return f;
}

/// All coefficients of the first harmonics.
Family fourier(int harmonics)
{
  Family f;
  for (int k = 1; k <= harmonics; ++k) {
    for (const bool sine : {false, true}) {
      for (int axis = 0; axis < 3; ++axis) {
        const std::string name = (sine ? "s" : "c") + std::to_string(k) + "." + "xyz"[axis];
        const std::size_t at = f.add(name, 0.0, -largest_length, "coefficient of the core");
        f.terms.push_back({k, sine, axis, at, 1.0});
      }
    }
  }
  return f;
}

}  // namespace

void closed_tube_fields(std::vector<Field>& out)
{
  Field curve;
  curve.name = "curve";
  curve.kind = Field::Kind::choice;
  curve.required = true;
  curve.choices = {"oval", "racetrack", "polygon", "knot", "fourier"};
  curve.doc =
      "Family of the tube's core, in the element's xy-plane but for knots: oval (half_length, half_width), "
      "racetrack (the same, with straight sides), polygon (R, corner), knot (R, a, b), fourier (c1.x, c1.y, "
      "c1.z, s1.x, ...: all coefficients of cos u, sin u, cos 2 u, ...); and r, the tube's radius.";
  out.push_back(std::move(curve));
  out.push_back(
      kit::integer_field("corners", "", 2, most_harmonics, "Of a polygon: its corners; 3 without."));
  Field turns;
  turns.name = "turns";
  turns.kind = Field::Kind::numbers;
  turns.min_items = turns.max_items = 2;
  turns.minimum = 1;
  turns.maximum = most_turns;
  turns.doc =
      "Of a knot: how often it goes around the axis and up and down meanwhile, without common divisor; "
      "[2, 3] without: a trefoil.";
  out.push_back(std::move(turns));
  out.push_back(kit::integer_field("harmonics", "", 1, most_harmonics, "Of fourier: how many; 3 without."));
}

std::unique_ptr<Shape> make_closed_tube(const Node& section, Problems& problems)
{
  const std::string& name = section.at("curve").string;
  const auto belongs = [&](const char* field, const char* to) -> const Node* {
    const Node* node = section.find(field);
    if (node != nullptr && name != to) {
      problems.add(*node, std::string("belongs to curve '") + to + "'; remove it or choose that curve");
    }
    return node;
  };
  const std::size_t before = problems.list().size();
  const Node *corners = belongs("corners", "polygon"), *turns = belongs("turns", "knot"),
             *harmonics = belongs("harmonics", "fourier");
  int p = 2, q = 3;
  if (turns != nullptr) {
    p = static_cast<int>(turns->items[0].number);
    q = static_cast<int>(turns->items[1].number);
    if (p != turns->items[0].number || q != turns->items[1].number || std::gcd(p, q) != 1 || p == q) {
      problems.add(*turns, "expected two different whole numbers without common divisor, such as [2, 3]");
    }
  }
  if (problems.list().size() != before) return nullptr;
  const auto count = [](const Node* node) { return node != nullptr ? static_cast<int>(node->number) : 3; };
  Family family = name == "oval"        ? oval()
                  : name == "racetrack" ? racetrack()
                  : name == "polygon"   ? polygon(count(corners))
                  : name == "knot"      ? knot(p, q)
                                        : fourier(count(harmonics));
  family.size("r", "radius of the tube");
  return std::make_unique<ClosedTube>(std::move(family.parameters), std::move(family.terms));
}

}  // namespace hauberk
