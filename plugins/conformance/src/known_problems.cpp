#include <hauberk/conformance/known_problems.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace hauberk::conformance {
namespace {

using Eigen::MatrixXd;

constexpr double infinity = std::numeric_limits<double>::infinity();

KnownProblem known(std::string name, FunctionProblem problem, std::vector<double> start,
                   std::optional<double> value, std::vector<double> solution = {})
{
  KnownProblem k;
  k.name = std::move(name);
  k.problem = std::move(problem);
  k.start = std::move(start);
  k.value = value;
  k.solution = std::move(solution);
  return k;
}

/// 1/2 x.A x - b.x with A = tridiag(-1, 2, -1), so that at the solution the gradient points out of active
/// bounds and vanishes elsewhere.
KnownProblem quadratic()
{
  constexpr int n = 6;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  A.diagonal().setConstant(2.0);
  A.diagonal(1).setConstant(-1.0);
  A.diagonal(-1).setConstant(-1.0);
  VectorXd solution(n), slope(n);
  solution << 1.0, 0.25, -1.0, 0.5, 1.0, -0.75;
  slope << -1.0, 0.0, 2.0, 0.0, -0.5, 0.0;
  const VectorXd b = A * solution - slope;
  FunctionProblem p = box(n, -1.0, 1.0);
  p.objective = [A, b](const VectorXd& x, VectorXd& g) {
    g = A * x - b;
    return 0.5 * x.dot(A * x) - b.dot(x);
  };
  p.hessian_function = [A](const VectorXd&, double weight, const VectorXd&) -> MatrixXd {
    return weight * A;
  };
  const double value = 0.5 * solution.dot(A * solution) - b.dot(solution);
  return known("quadratic", std::move(p), std::vector<double>(n, 0.0), value,
               {solution.begin(), solution.end()});
}

// ----- equations: Hock and Schittkowski, Test Examples for Nonlinear Programming Codes (1981) -----

/// (1 - x0)^2 where 10 (x1 - x0^2) = 0.
KnownProblem hs6()
{
  FunctionProblem p = box(2, -infinity, infinity);
  p.objective = [](const VectorXd& x, VectorXd& g) {
    g << 2.0 * (x[0] - 1.0), 0.0;
    return (1.0 - x[0]) * (1.0 - x[0]);
  };
  p.constraint_number = p.equality_number = 1;
  p.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c << 10.0 * (x[1] - x[0] * x[0]);
    J << -20.0 * x[0], 10.0;
  };
  p.hessian_function = [](const VectorXd&, double weight, const VectorXd& l) {
    MatrixXd H = MatrixXd::Zero(2, 2);
    H(0, 0) = 2.0 * weight + 20.0 * l[0];
    return H;
  };
  return known("hs6", std::move(p), {-1.2, 1.0}, 0.0, {1.0, 1.0});
}

/// log(1 + x0^2) - x1 where (1 + x0^2)^2 + x1^2 = 4.
KnownProblem hs7()
{
  FunctionProblem p = box(2, -infinity, infinity);
  p.objective = [](const VectorXd& x, VectorXd& g) {
    const double q = 1.0 + x[0] * x[0];
    g << 2.0 * x[0] / q, -1.0;
    return std::log(q) - x[1];
  };
  p.constraint_number = p.equality_number = 1;
  p.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    const double q = 1.0 + x[0] * x[0];
    c << q * q + x[1] * x[1] - 4.0;
    J << 4.0 * x[0] * q, 2.0 * x[1];
  };
  p.hessian_function = [](const VectorXd& x, double weight, const VectorXd& l) {
    const double s = x[0] * x[0], q = 1.0 + s;
    MatrixXd H = MatrixXd::Zero(2, 2);
    H(0, 0) = weight * 2.0 * (1.0 - s) / (q * q) - l[0] * (4.0 * q + 8.0 * s);
    H(1, 1) = -2.0 * l[0];
    return H;
  };
  return known("hs7", std::move(p), {2.0, 2.0}, -std::sqrt(3.0), {0.0, std::sqrt(3.0)});
}

/// Half a sum of squares of A x - b where E x = e.
KnownProblem linear_least_squares(std::string name, const MatrixXd& A, const VectorXd& b, const MatrixXd& E,
                                  const VectorXd& e, std::vector<double> start, std::vector<double> solution)
{
  FunctionProblem p = box(start.size(), -infinity, infinity);
  p.objective = [A, b](const VectorXd& x, VectorXd& g) {
    g = A.transpose() * (A * x - b);
    return 0.5 * (A * x - b).squaredNorm();
  };
  p.constraint_number = p.equality_number = static_cast<int>(e.size());
  p.constraint_functions = [E, e](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c = E * x - e;
    J = E;
  };
  p.hessian_function = [A](const VectorXd&, double weight, const VectorXd&) -> MatrixXd {
    return weight * A.transpose() * A;
  };
  return known(std::move(name), std::move(p), std::move(start), 0.0, std::move(solution));
}

/// ((x0 + x1)^2 + (x1 + x2)^2)/2 where x0 + 2 x1 + 3 x2 = 1: half the published objective.
KnownProblem hs28()
{
  const MatrixXd A = (MatrixXd(2, 3) << 1, 1, 0, 0, 1, 1).finished();
  const MatrixXd E = (MatrixXd(1, 3) << 1, 2, 3).finished();
  return linear_least_squares("hs28", A, VectorXd::Zero(2), E, VectorXd::Ones(1), {-4.0, 1.0, 1.0},
                              {0.5, -0.5, 0.5});
}

/// ((x0 - 1)^2 + (x1 - x2)^2 + (x3 - x4)^2)/2 where the sum is 5 and x2 - 2 (x3 + x4) = -3: half the
/// published objective.
KnownProblem hs48()
{
  const MatrixXd A = (MatrixXd(3, 5) << 1, 0, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0, 0, 1, -1).finished();
  const MatrixXd E = (MatrixXd(2, 5) << 1, 1, 1, 1, 1, 0, 0, 1, -2, -2).finished();
  return linear_least_squares("hs48", A, Eigen::Vector3d(1, 0, 0), E, Eigen::Vector2d(5, -3),
                              {3.0, 5.0, -3.0, 2.0, -2.0}, std::vector<double>(5, 1.0));
}

/// 1 + x.x = 0, although linearisations away from 0 have solutions.
KnownProblem no_root()
{
  FunctionProblem p = rosenbrock(-2.0, 2.0);
  p.hessian_function = nullptr;  // that of the constraint is not in it
  p.constraint_number = p.equality_number = 1;
  p.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c << 1.0 + x.squaredNorm();
    J.row(0) = 2.0 * x;
  };
  KnownProblem k = known("no_root", std::move(p), {-1.2, 1.0}, std::nullopt);
  k.feasible = false;
  return k;
}

/// Hessian of the objective of hs71, and of x0 x1 x2 x3.
MatrixXd hs71_objective_hessian(const VectorXd& x)
{
  MatrixXd H = MatrixXd::Zero(4, 4);
  H(0, 0) = 2.0 * x[3];
  H(0, 1) = H(1, 0) = H(0, 2) = H(2, 0) = x[3];
  H(0, 3) = H(3, 0) = 2.0 * x[0] + x[1] + x[2];
  H(1, 3) = H(3, 1) = H(2, 3) = H(3, 2) = x[0];
  return H;
}

MatrixXd product_hessian(const VectorXd& x)
{
  MatrixXd H = MatrixXd::Zero(4, 4);
  for (Eigen::Index i = 0; i < 4; ++i) {
    for (Eigen::Index k = 0; k < 4; ++k) {
      if (i != k) H(i, k) = x.prod() / (x[i] * x[k]);
    }
  }
  return H;
}

KnownProblem rosenbrock_on_its_bound()
{
  FunctionProblem p = rosenbrock(-2.0, 2.0);
  p.upper_bounds[0] = 0.5;
  return known("rosenbrock_bound", std::move(p), {-1.2, 1.0}, 0.25, {0.5, 0.25});
}

KnownProblem degenerate()
{
  FunctionProblem p = box(2, 0.0, 4.0);
  p.objective = [](const VectorXd& x, VectorXd& g) {
    g = 2.0 * x;
    return x.squaredNorm();
  };
  p.constraint_number = 5;
  p.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    J << 1, 0, 0, 1, 1, 1, 1, 1, 3, 1;
    c = J * x;
    c -= (VectorXd(5) << 1.0, 1.0, 2.0, 2.0, 4.0).finished();
  };
  return known("degenerate", std::move(p), {3.0, 2.5}, 2.0, {1.0, 1.0});
}

KnownProblem contradiction()
{
  FunctionProblem p = rosenbrock(-2.0, 2.0);
  p.constraint_number = 2;  // both linear
  p.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c << x[0] - 1.0, -0.5 - x[0];
    J << 1, 0, -1, 0;
  };
  KnownProblem k = known("contradiction", std::move(p), {-1.2, 1.0}, std::nullopt);
  k.feasible = false;
  return k;
}

/// -1 - x.x >= 0, although every linearisation away from 0 has a solution.
KnownProblem no_ball()
{
  FunctionProblem p = rosenbrock(-2.0, 2.0);
  p.hessian_function = nullptr;  // that of the constraint is not in it
  p.constraint_number = 1;
  p.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c << -1.0 - x.squaredNorm();
    J.row(0) = -2.0 * x;
  };
  KnownProblem k = known("no_ball", std::move(p), {-1.2, 1.0}, std::nullopt);
  k.feasible = false;
  return k;
}

KnownProblem kinked()
{
  const double t = 1.4 / (1.96 + 0.25);
  const double least = 3.0 * ((1.4 * t - 1.0) * (1.4 * t - 1.0) + 0.25 * t * t);
  return known("kinked", sum_of_squares(box(6, -2.0, 3.0), 12, kinked_residuals, true),
               {-1.0, 2.0, 0.3, -0.7, 1.4, 0.1}, least, std::vector<double>(6, t));
}

KnownProblem failing()
{
  FunctionProblem p = rosenbrock(-2.0, 2.0);
  p.fails = [](const VectorXd& x) { return x[1] < x[0] * x[0] - 0.5; };
  return known("failing", std::move(p), {-1.2, 1.0}, 0.0, {1.0, 1.0});
}

KnownProblem not_a_number()
{
  FunctionProblem p = rosenbrock(-2.0, 2.0);
  const auto smooth = p.objective;
  p.objective = [smooth](const VectorXd& x, VectorXd& g) {
    const double value = smooth(x, g);
    if (x[1] < x[0] * x[0] - 0.5) return std::numeric_limits<double>::quiet_NaN();
    if (x[1] > x[0] * x[0] + 0.5) g[1] = infinity;
    return value;
  };
  return known("not_a_number", std::move(p), {-1.2, 1.0}, 0.0, {1.0, 1.0});
}

KnownProblem short_way()
{
  FunctionProblem p = rosenbrock(-2.0, 2.0);
  p.safe = [](const VectorXd&, const VectorXd& d) { return d.norm() > 0.2 ? 0.2 / d.norm() : 1.0; };
  return known("short_way", std::move(p), {-1.2, 1.0}, 0.0, {1.0, 1.0});
}

KnownProblem wall()
{
  FunctionProblem p = rosenbrock(-2.0, 2.0);
  p.safe = [](const VectorXd& x, const VectorXd& d) {
    return d[0] <= 0.0 ? 1.0 : std::clamp((0.4 - x[0]) / d[0], 0.0, 1.0);
  };
  KnownProblem k = known("wall", std::move(p), {-1.2, 1.0}, std::nullopt);
  k.wall = 0.4;
  return k;
}

}  // namespace

FunctionProblem box(std::size_t n, double lower, double upper)
{
  FunctionProblem p;
  p.lower_bounds.assign(n, lower);
  p.upper_bounds.assign(n, upper);
  return p;
}

FunctionProblem rosenbrock(double lower, double upper)
{
  FunctionProblem p = box(2, lower, upper);
  p.objective = [](const VectorXd& x, VectorXd& g) {
    const double a = x[1] - x[0] * x[0];
    const double b = 1.0 - x[0];
    g << -400.0 * a * x[0] - 2.0 * b, 200.0 * a;
    return 100.0 * a * a + b * b;
  };
  p.hessian_function = [](const VectorXd& x, double weight, const VectorXd&) -> MatrixXd {
    return weight * Eigen::Matrix2d{{1200.0 * x[0] * x[0] - 400.0 * x[1] + 2.0, -400.0 * x[0]},
                                    {-400.0 * x[0], 200.0}};
  };
  return p;
}

FunctionProblem rosenbrock_in_units(double unit)
{
  FunctionProblem p = rosenbrock(-2.0 / unit, 2.0 / unit);
  const auto plain = p.objective;
  p.objective = [plain, unit](const VectorXd& x, VectorXd& g) {
    const double value = plain(unit * x, g);
    g *= unit;
    return value;
  };
  p.hessian_function = nullptr;
  return p;
}

FunctionProblem hs71()
{
  FunctionProblem p = box(4, 1.0, 5.0);
  p.objective = [](const VectorXd& x, VectorXd& g) {
    const double sum = x[0] + x[1] + x[2];
    g << x[3] * (sum + x[0]), x[0] * x[3], x[0] * x[3] + 1.0, x[0] * sum;
    return x[0] * x[3] * sum + x[2];
  };
  p.constraint_number = 3;
  p.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c << x.prod() - 25.0, x.squaredNorm() - 40.0, 40.0 - x.squaredNorm();
    J.row(0) = x.prod() * x.cwiseInverse();
    J.row(1) = 2.0 * x;
    J.row(2) = -2.0 * x;
  };
  p.hessian_function = [](const VectorXd& x, double weight, const VectorXd& l) -> MatrixXd {
    return weight * hs71_objective_hessian(x) - l[0] * product_hessian(x) -
           2.0 * (l[1] - l[2]) * MatrixXd::Identity(4, 4);
  };
  return p;
}

FunctionProblem hs71_equation()
{
  FunctionProblem p = hs71();
  p.constraint_number = 2;
  p.equality_number = 1;
  p.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c << x.squaredNorm() - 40.0, x.prod() - 25.0;
    J.row(0) = 2.0 * x;
    J.row(1) = x.prod() * x.cwiseInverse();
  };
  p.hessian_function = [](const VectorXd& x, double weight, const VectorXd& l) -> MatrixXd {
    return weight * hs71_objective_hessian(x) - 2.0 * l[0] * MatrixXd::Identity(4, 4) -
           l[1] * product_hessian(x);
  };
  return p;
}

FunctionProblem hs76()
{
  FunctionProblem p = box(4, 0.0, 10.0);
  p.objective = [](const VectorXd& x, VectorXd& g) {
    g << 2 * x[0] - x[2] - 1, x[1] - 3, 2 * x[2] - x[0] + x[3] + 1, x[3] + x[2] - 1;
    return x[0] * x[0] + 0.5 * x[1] * x[1] + x[2] * x[2] + 0.5 * x[3] * x[3] - x[0] * x[2] + x[2] * x[3] -
           x[0] - 3 * x[1] + x[2] - x[3];
  };
  p.constraint_number = 3;
  p.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    J << -1, -2, -1, -1, -3, -1, -2, 1, 0, 1, 4, 0;
    c = J * x + Eigen::Vector3d(5.0, 4.0, -1.5);
  };
  p.hessian_function = [](const VectorXd&, double weight, const VectorXd&) -> MatrixXd {
    return weight * Eigen::Matrix4d{{2, 0, -1, 0}, {0, 1, 0, 0}, {-1, 0, 2, 1}, {0, 0, 1, 1}};
  };
  return p;
}

FunctionProblem farthest_in_disk(double half_range)
{
  FunctionProblem p = box(2, -half_range, half_range);
  p.objective = [](const VectorXd& x, VectorXd& g) {
    g << -3.0, -4.0;
    return g.dot(x);
  };
  p.constraint_number = 1;
  p.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c << 1.0 - x.squaredNorm();
    J.row(0) = -2.0 * x;
  };
  p.hessian_function = [](const VectorXd&, double, const VectorXd& l) -> MatrixXd {
    return 2.0 * l[0] * MatrixXd::Identity(2, 2);
  };
  return p;
}

FunctionProblem sum_of_squares(FunctionProblem problem, int count,
                               std::function<void(const VectorXd&, VectorXd&, RowMajor&)> residuals,
                               bool shown)
{
  problem.objective = [count, residuals](const VectorXd& x, VectorXd& g) {
    VectorXd r(count);
    RowMajor J(count, x.size());
    residuals(x, r, J);
    g = J.transpose() * r;
    return 0.5 * r.squaredNorm();
  };
  if (!shown) return problem;
  problem.residual_number = count;
  problem.residual_functions = std::move(residuals);
  return problem;
}

void kinked_residuals(const VectorXd& x, VectorXd& r, RowMajor& J)
{
  constexpr int n = 6;
  J.setZero();
  for (int i = 0; i < n; ++i) {
    VectorXd a = VectorXd::Zero(n), b = VectorXd::Zero(n);
    a[i] = 1.0;
    a[(i + 1) % n] = 0.4;
    b[(i + 2) % n] = 0.9;
    b[(i + 3) % n] = 0.5;
    const VectorXd& g = a.dot(x) <= b.dot(x) ? a : b;
    r[i] = g.dot(x) - 1.0;
    J.row(i) = g.transpose();
    r[n + i] = 0.5 * x[i];
    J(n + i, i) = 0.5;
  }
}

std::vector<KnownProblem> known_problems()
{
  std::vector<KnownProblem> all;
  all.push_back(quadratic());
  all.push_back(known("rosenbrock", rosenbrock(-infinity, infinity), {-1.2, 1.0}, 0.0, {1.0, 1.0}));
  all.push_back(rosenbrock_on_its_bound());
  // The optimum to ten digits, from Newton's method on its equations.
  all.push_back(known("hs71", hs71(), {1.0, 5.0, 5.0, 1.0}, 17.0140172891,
                      {1.0, 4.7429996372, 3.8211499843, 1.3794082932}));
  all.push_back(
      known("hs76", hs76(), {0.5, 0.5, 0.5, 0.5}, -103.0 / 22.0, {3.0 / 11.0, 23.0 / 11.0, 0.0, 6.0 / 11.0}));
  all.push_back(known("circle", farthest_in_disk(2.0), {0.1, -0.3}, -5.0, {0.6, 0.8}));
  all.push_back(degenerate());
  all.push_back(contradiction());
  all.push_back(no_ball());
  all.push_back(kinked());
  all.push_back(hs6());
  all.push_back(hs7());
  all.push_back(hs28());
  all.push_back(hs48());
  all.push_back(known("hs71_equation", hs71_equation(), {1.0, 5.0, 5.0, 1.0}, 17.0140172891,
                      {1.0, 4.7429996372, 3.8211499843, 1.3794082932}));
  all.push_back(no_root());
  all.push_back(failing());
  all.push_back(not_a_number());
  all.push_back(short_way());
  all.push_back(wall());
  return all;
}

KnownProblem known_problem(const std::string& name)
{
  for (KnownProblem& problem : known_problems()) {
    if (problem.name == name) return std::move(problem);
  }
  throw std::out_of_range("no known problem " + name);
}

}  // namespace hauberk::conformance
