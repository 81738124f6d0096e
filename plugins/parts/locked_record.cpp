#include "parts/locked_record.hpp"

#include <array>
#include <span>

namespace hauberk {
namespace {

std::span<const double> all_of(const Vector& x) { return {x.data(), static_cast<std::size_t>(x.size())}; }

/// Rows, columns, and the entries by columns.
void write(const Matrix& x, RecordWriter& out)
{
  out.number(x.rows());
  out.number(x.cols());
  out.numbers({x.data(), static_cast<std::size_t>(x.size())});
}

Matrix read_matrix(RecordReader& in)
{
  const auto rows = in.number<Eigen::Index>(), columns = in.number<Eigen::Index>();
  const std::vector<double> x = in.numbers();
  const auto size = static_cast<Eigen::Index>(x.size());
  in.good = in.good && rows >= 0 && columns >= 0 &&
            (rows == 0 || columns == 0 ? size == 0 : size % rows == 0 && size / rows == columns);
  return in.good ? Matrix(Eigen::Map<const Matrix>(x.data(), rows, columns)) : Matrix();
}

Vector read_vector(RecordReader& in)
{
  const std::vector<double> x = in.numbers();
  return Eigen::Map<const Vector>(x.data(), static_cast<Eigen::Index>(x.size()));
}

void write(const Vec3& x, RecordWriter& out)
{
  for (const double v : x) out.number(v);
}

Vec3 read_point(RecordReader& in)
{
  const auto x = in.number<double>(), y = in.number<double>(), z = in.number<double>();
  return {x, y, z};
}

template <class Enum>
void write_word(Enum value, RecordWriter& out)
{
  out.number(static_cast<int>(value));
}

/// An enumerator up to `last`.
template <class Enum>
Enum read_word(RecordReader& in, Enum last)
{
  const auto value = in.number<int>();
  in.good = in.good && value >= 0 && value <= static_cast<int>(last);
  return in.good ? static_cast<Enum>(value) : Enum{};
}

bool read_flag(RecordReader& in)
{
  const auto value = in.number<int>();
  in.good = in.good && (value == 0 || value == 1);
  return value == 1;
}

void write(const State& s, RecordWriter& out)
{
  out.numbers(all_of(s.macro));
  out.numbers(all_of(s.e));
  out.number(s.rotation.size());
  for (const Mat3& Q : s.rotation)
    for (int k = 0; k < 9; ++k) out.number(Q.data()[k]);
}

State read_state(RecordReader& in)
{
  State s;
  s.macro = read_vector(in);
  s.e = read_vector(in);
  s.rotation.resize(in.count());
  for (Mat3& Q : s.rotation)
    for (int k = 0; k < 9; ++k) Q.data()[k] = in.number<double>();
  return s;
}

void write(const std::vector<State>& states, RecordWriter& out)
{
  out.number(states.size());
  for (const State& s : states) write(s, out);
}

std::vector<State> read_states(RecordReader& in)
{
  std::vector<State> states;
  for (std::size_t left = in.count(); left > 0 && in.good; --left) states.push_back(read_state(in));
  return states;
}

/// What a stage's end is read for; how far it might have gone is not.
void write(const Stage& s, RecordWriter& out)
{
  write_word(s.contact.formulation, out);
  out.number(s.contact.g_hat);
  out.number(s.contact.clearance);
  write_word(s.contact.search, out);
  out.number(s.contact.panel_ratio);
  write_word(s.contact.quadrature, out);
  write_word(s.contact.sides, out);
  out.number(s.mu);
  write_word(s.ccd, out);
  out.number(s.target);
  write(s.tether, out);
  out.number(s.tether_stiffness);
  out.number(s.least_curvature);
  out.number(static_cast<int>(s.balance));
  out.number(s.tolerance);
  out.number(static_cast<int>(s.keep_path));
  out.number(s.most_iterations);
}

Stage read_stage(RecordReader& in)
{
  Stage s;
  s.contact.formulation = read_word(in, last_formulation);
  s.contact.g_hat = in.number<double>();
  s.contact.clearance = in.number<double>();
  s.contact.search = read_word(in, MinimaSearch::sampled);
  s.contact.panel_ratio = in.number<double>();
  s.contact.quadrature = read_word(in, Quadrature::rough);
  s.contact.sides = read_word(in, Sides::ribbon);
  s.mu = in.number<double>();
  s.ccd = read_word(in, CollisionCheck::sampled);
  s.target = in.number<double>();
  s.tether = read_matrix(in);
  s.tether_stiffness = in.number<double>();
  s.least_curvature = in.number<double>();
  s.balance = read_flag(in);
  s.tolerance = in.number<double>();
  s.keep_path = read_flag(in);
  s.most_iterations = in.number<int>();
  return s;
}

void write(const StageRecord& s, RecordWriter& out)
{
  out.number(s.g_hat);
  out.number(s.value);
  write_word(s.formulation, out);
  out.number(s.iterations);
  out.number(s.residual);
  out.number(s.escapes);
}

StageRecord read_stage_record(RecordReader& in)
{
  StageRecord s;
  s.g_hat = in.number<double>();
  s.value = in.number<double>();
  s.formulation = read_word(in, last_formulation);
  s.iterations = in.number<int>();
  s.residual = in.number<double>();
  s.escapes = in.number<int>();
  return s;
}

void write(const ContactEnergy::Point& p, RecordWriter& out)
{
  out.number(p.a);
  out.number(p.b);
  for (const int k : p.image) out.number(k);
  write(p.contact.on_p, out);
  write(p.contact.on_f, out);
  write(p.contact.normal, out);
  out.number(p.contact.gap);
  out.number(p.contact.force);
  out.number(p.wall);
}

ContactEnergy::Point read_contact(RecordReader& in)
{
  ContactEnergy::Point p;
  p.a = in.number<int>();
  p.b = in.number<int>();
  for (int& k : p.image) k = in.number<int>();
  p.contact.on_p = read_point(in);
  p.contact.on_f = read_point(in);
  p.contact.normal = read_point(in);
  p.contact.gap = in.number<double>();
  p.contact.force = in.number<double>();
  p.wall = in.number<int>();
  return p;
}

void write(const ContactEnergy& e, RecordWriter& out)
{
  out.number(e.energy);
  out.numbers(all_of(e.gradient));
  out.number(e.min_gap);
  out.number(e.regularity);
  out.number(e.evaluations);
  out.number(e.d_clearance);
  write(e.parameters, out);
  out.number(e.points.size());
  for (const ContactEnergy::Point& p : e.points) write(p, out);
}

ContactEnergy read_contacts(RecordReader& in)
{
  ContactEnergy e;
  e.energy = in.number<double>();
  e.gradient = read_vector(in);
  e.min_gap = in.number<double>();
  e.regularity = in.number<double>();
  e.evaluations = in.number<long>();
  e.d_clearance = in.number<double>();
  e.parameters = read_matrix(in);
  for (std::size_t left = in.count(); left > 0 && in.good; --left) e.points.push_back(read_contact(in));
  return e;
}

}  // namespace

bool is_recordable(const Locked& l)
{
  return !l.pressed || (l.pressed->hessian.isZero(0.0) && l.pressed->sparse_hessian.nonZeros() == 0);
}

void write_locked(const Locked& l, RecordWriter& out)
{
  write_word(l.status, out);
  out.words(l.message);
  write(l.state, out);
  write(l.stage, out);
  out.number(l.stages.size());
  for (const StageRecord& s : l.stages) write(s, out);
  out.number(l.iterations);
  out.number(l.evaluations);
  write(l.trail, out);
  write(l.path, out);
  out.number(l.error_estimate ? 1 : 0);
  if (l.error_estimate) out.number(*l.error_estimate);
  out.number(l.pressed ? 1 : 0);
  if (l.pressed) write(*l.pressed, out);
}

Locked read_locked(RecordReader& in)
{
  Locked l;
  l.status = read_word(in, LockStatus::not_a_sheet);
  l.message = in.words();
  l.state = read_state(in);
  l.stage = read_stage(in);
  for (std::size_t left = in.count(); left > 0 && in.good; --left) l.stages.push_back(read_stage_record(in));
  l.iterations = in.number<int>();
  l.evaluations = in.number<long>();
  l.trail = read_states(in);
  l.path = read_states(in);
  if (read_flag(in)) l.error_estimate = in.number<double>();
  if (read_flag(in)) l.pressed = read_contacts(in);
  return l;
}

}  // namespace hauberk
