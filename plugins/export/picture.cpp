#include "export/picture.hpp"

#include "export/formats.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace hauberk::exporting {
namespace {

constexpr int samples = 2;  ///< along each side of a pixel

/// Axes of the picture in the world: right, up, and towards the eye.
struct Camera {
  Vec3 right, up, eye;

  explicit Camera(const View& view)
  {
    const double a = view.azimuth * std::numbers::pi / 180.0, e = view.elevation * std::numbers::pi / 180.0;
    right = {std::cos(a), std::sin(a), 0.0};
    eye = {std::cos(e) * std::sin(a), -std::cos(e) * std::cos(a), std::sin(e)};
    up = eye.cross(right);
  }
  Vec3 project(const Vec3& x) const { return {right.dot(x), up.dot(x), eye.dot(x)}; }
};

/// Colours and depths of samples.
class Canvas {
 public:
  Canvas(int width, int height)
      : width_(width * samples),
        height_(height * samples),
        depth_(static_cast<std::size_t>(width_) * height_, -std::numeric_limits<double>::infinity()),
        colour_(depth_.size(), Vec3::Constant(255.0))
  {
  }

  /// A triangle by its corners in samples (x to the right, y downwards, z towards the eye), coloured by a
  /// normal that is interpolated.
  template <class Shade>
  void fill(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& normal, const Shade& shade)
  {
    const double area =
        (p[1] - p[0]).head<2>().x() * (p[2] - p[0]).y() - (p[1] - p[0]).y() * (p[2] - p[0]).x();
    if (area == 0.0) return;
    const auto range = [](double low, double high, int most) {
      // Beyond the picture numbers may be larger than any integer.
      const double first = std::clamp(std::ceil(low - 0.5), 0.0, static_cast<double>(most)),
                   last = std::clamp(std::floor(high - 0.5), -1.0, most - 1.0);
      return std::pair{static_cast<int>(first), static_cast<int>(last)};
    };
    const auto [x0, x1] =
        range(std::min({p[0].x(), p[1].x(), p[2].x()}), std::max({p[0].x(), p[1].x(), p[2].x()}), width_);
    const auto [y0, y1] =
        range(std::min({p[0].y(), p[1].y(), p[2].y()}), std::max({p[0].y(), p[1].y(), p[2].y()}), height_);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const auto edge = [&](const Vec3& a, const Vec3& b) {
          return ((b.x() - a.x()) * (py - a.y()) - (b.y() - a.y()) * (px - a.x())) / area;
        };
        const double w0 = edge(p[1], p[2]), w1 = edge(p[2], p[0]), w2 = 1.0 - w0 - w1;
        if (w0 < 0.0 || w1 < 0.0 || w2 < 0.0) continue;
        const double z = w0 * p[0].z() + w1 * p[1].z() + w2 * p[2].z();
        const std::size_t at = static_cast<std::size_t>(y) * width_ + x;
        if (z <= depth_[at]) continue;
        depth_[at] = z;
        colour_[at] = shade(Vec3((w0 * normal[0] + w1 * normal[1] + w2 * normal[2]).normalized()), z);
      }
    }
  }

  Raster averaged() const
  {
    Raster out{width_ / samples, height_ / samples, {}};
    for (int y = 0; y < out.height; ++y) {
      for (int x = 0; x < out.width; ++x) {
        Vec3 sum = Vec3::Zero();
        for (int j = 0; j < samples; ++j)
          for (int i = 0; i < samples; ++i)
            sum += colour_[static_cast<std::size_t>(y * samples + j) * width_ + x * samples + i];
        for (const double c : sum / (samples * samples))
          out.rgb.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(c, 0.0, 255.0))));
      }
    }
    return out;
  }

 private:
  int width_, height_;
  std::vector<double> depth_;
  std::vector<Vec3> colour_;
};

/// A copy's points and normals as the camera sees them.
struct Seen {
  std::vector<Vec3> points, normals;
};

/// Lowest and highest coordinates as the camera sees them.
std::pair<Vec3, Vec3> extent(const Assembly& assembly, const Camera& camera)
{
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& copy : assembly.copies) {
    for (const Vec3& x : assembly.meshes[copy.mesh].points) {
      const Vec3 p = camera.project(copy.pose.position + copy.pose.rotation * x);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  return {low, high};
}

Seen seen_by(const Camera& camera, const Mesh& mesh, const std::vector<Vec3>& normals, const Pose& pose)
{
  Seen out;
  for (const Vec3& x : mesh.points) out.points.push_back(camera.project(pose.position + pose.rotation * x));
  for (const Vec3& n : normals) out.normals.push_back(camera.project(pose.rotation * n));
  return out;
}

}  // namespace

View view_of(const std::string& text)
{
  if (text == "top") return {0.0, 90.0};
  if (text == "front") return {0.0, 0.0};
  if (text == "side") return {90.0, 0.0};
  if (text == "iso") return {30.0, 35.0};
  View view;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, view.azimuth);
  if (first.ec == std::errc{} && first.ptr != end && *first.ptr == ',') {
    const auto second = std::from_chars(first.ptr + 1, end, view.elevation);
    if (second.ec == std::errc{} && second.ptr == end && std::abs(view.elevation) <= 90.0 &&
        std::abs(view.azimuth) <= 360.0)
      return view;
  }
  throw InputError(fmt::format(
      "--view {}: expected top, front, side, iso, or AZIMUTH,ELEVATION in degrees, as 30,35", text));
}

double scale_that_fits(const Assembly& assembly, const View& view, int width, int height)
{
  const auto [low, high] = extent(assembly, Camera(view));
  constexpr double margin = 0.04, least = 1e-300;
  return (1.0 - 2.0 * margin) *
         std::min(width / std::max(high.x() - low.x(), least), height / std::max(high.y() - low.y(), least));
}

Raster render(const Assembly& assembly, const View& view, int width, int height, double scale)
{
  const Camera camera(view);
  std::vector<std::vector<Vec3>> normals;
  for (const Mesh& mesh : assembly.meshes) normals.push_back(point_normals(mesh));
  const auto [low, high] = extent(assembly, camera);
  scale *= samples;
  const Vec3 middle = 0.5 * (low + high), light = Vec3(-0.35, 0.5, 0.8).normalized();
  const double depth = std::max(high.z() - low.z(), 1e-300);
  Canvas canvas(width, height);
  for (const auto& copy : assembly.copies) {
    const Mesh& mesh = assembly.meshes[copy.mesh];
    const auto rgb = colour_of(copy.element);
    const Vec3 colour(rgb[0], rgb[1], rgb[2]);
    const auto shade = [&](const Vec3& n, double z) -> Vec3 {
      const double bright = 0.30 + 0.70 * std::max(0.0, n.dot(light)),
                   glint = std::pow(std::max(0.0, n.dot(light)), 30.0);
      const double near = 0.72 + 0.28 * (z / scale - low.z()) / depth;
      return near * (bright * colour + 70.0 * glint * Vec3::Ones());
    };
    Seen seen = seen_by(camera, mesh, normals[copy.mesh], copy.pose);
    for (Vec3& p : seen.points) {
      p = Vec3(0.5 * samples * width + scale * (p.x() - middle.x()),
               0.5 * samples * height - scale * (p.y() - middle.y()), scale * p.z());
    }
    for (const auto& t : mesh.triangles)
      canvas.fill({seen.points[t[0]], seen.points[t[1]], seen.points[t[2]]},
                  {seen.normals[t[0]], seen.normals[t[1]], seen.normals[t[2]]}, shade);
  }
  return canvas.averaged();
}

}  // namespace hauberk::exporting
