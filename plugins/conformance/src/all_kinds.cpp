/// Checks of plugins of every kind.

#include "checks.hpp"
#include "document/check.hpp"
#include "trace.hpp"

#include <hauberk/error.hpp>
#include <hauberk/host/factories.hpp>
#include <hauberk/host/floating_point.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <set>
#include <thread>

namespace hauberk::conformance {
namespace {

constexpr std::size_t threads = 4;

bool one_line(std::string_view text)
{
  return !text.empty() &&
         std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; });
}

void descriptor(const PluginTable& table)
{
  const std::string_view id = table.id;
  const bool plain = std::all_of(id.begin(), id.end(), [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  require(plain && !id.empty(), "the id '{}' is not made of letters, digits, '_' and '-'", id);
  for (const auto& [name, text] : {std::pair("version", table.version), std::pair("summary", table.summary),
                                   std::pair("citation", table.citation)}) {
    require(one_line(text), "the {} is '{}'; expected one line that is not empty", name, text);
  }
}

void field_is_sound(const Field& field, const std::string& place, bool named)
{
  const auto say = [&](const char* what) { fail("field '{}' {}", place, what); };
  if (named && field.name.empty()) say("has no name");
  if (named && field.doc.empty()) say("has no doc");
  if (field.required && !field.default_json.empty()) say("is required and has a default; drop one of them");
  if (!(field.minimum <= field.maximum)) say("has a minimum above its maximum");
  if (field.min_items > field.max_items) say("has min_items above max_items");
  if (field.kind == Field::Kind::choice) {
    const std::set<std::string> distinct(field.choices.begin(), field.choices.end());
    if (distinct.empty()) say("has no choices");
    if (distinct.size() != field.choices.size()) say("has a choice twice");
  }
  const bool one_child = field.kind == Field::Kind::list || field.kind == Field::Kind::map;
  if (one_child && field.children.size() != 1) say("needs one child, which describes an item");
  if (field.kind == Field::Kind::any_of && field.children.size() < 2) say("is any_of fewer than two things");
  if (!field.default_json.empty()) {
    Node value = default_node(field, "");
    Problems problems;
    check_fields(value, field, problems);
    if (!problems.empty())
      fail("field '{}' refuses its own default {}: {}", place, field.default_json,
           problems.list().front().message);
  }
  const bool members = field.kind == Field::Kind::object;
  for (const Field& child : field.children)
    field_is_sound(child, place + "/" + (members ? child.name : "*"), members);
}

void fields(const PluginTable& table)
{
  const std::vector<Field> declared = plugin_fields(table);
  std::set<std::string> names;
  for (const Field& field : declared) {
    require(names.insert(field.name).second, "there are two fields '{}'", field.name);
    field_is_sound(field, field.name, true);
  }
  const std::size_t again = plugin_fields(table).size();
  require(again == declared.size(), "`fields` gives {} fields, and {} when asked again", declared.size(),
          again);
}

/// Whether `text` has a name of one of the fields in it, at any depth.
bool names_a_field(const std::string& text, const std::vector<Field>& fields)
{
  return std::any_of(fields.begin(), fields.end(), [&](const Field& field) {
    return (!field.name.empty() && mentions(text, field.name)) || names_a_field(text, field.children);
  });
}

void bad_values(Trial& trial)
{
  static_cast<void>(trial.make());
  for (const Variant& variant : variants(trial.section)) {
    Problems problems;
    try {
      static_cast<void>(trial.make(variant.values, problems));
    } catch (const InputError& error) {
      require(names_a_field(error.what(), trial.section.fields.children),
              "{} = {} is refused without naming a field: '{}'", variant.field, variant.value, error.what());
    }
    for (const Problem& p : problems.list()) {
      require(!p.message.empty() && (names_a_field(p.pointer, trial.section.fields.children) ||
                                     names_a_field(p.message, trial.section.fields.children)),
              "{} = {} is refused without naming a field: '{}: {}'", variant.field, variant.value, p.pointer,
              p.message);
    }
  }
}

/// Objects of other sections, which must not change what the first one says.
std::vector<Object> others(Trial& trial)
{
  std::vector<Object> out;
  out.push_back(trial.make());
  for (const Variant& variant : variants(trial.section)) {
    Problems problems;
    try {
      out.push_back(trial.make(variant.values, problems));
    } catch (const InputError&) {
      continue;
    }
    if (!problems.empty()) out.pop_back();
  }
  return out;
}

void instances(Trial& trial)
{
  const Object object = trial.make();
  const Exercise exercise(object, trial);
  const std::vector<double> before = exercise(object);
  {
    const std::vector<Object> more = others(trial);
    // Used, too: what they keep for themselves must be their own. Optimizers' others may take their time.
    if (!object.optimizer) {
      for (const Object& other : more) {
        try {
          const Exercise own(other, trial);
          static_cast<void>(own(other));
        } catch (const Failure&) {
          continue;  // a section that accepts no parameters at hand
        }
      }
    }
    const std::vector<double> beside = exercise(object);
    require(same_bits(before, beside), "an object answers otherwise once others exist: {}",
            first_difference(before, beside));
  }
  const std::vector<double> after = exercise(object);
  require(same_bits(before, after), "an object answers otherwise once others are gone: {}",
          first_difference(before, after));
}

void repeatable(Trial& trial)
{
  const Object object = trial.make();
  const Exercise exercise(object, trial);
  const std::vector<double> first = exercise(object);
  for (int k = 0; k < 3; ++k) {
    const std::vector<double> again = exercise(object);
    require(same_bits(first, again), "asked again, it answers otherwise: {}", first_difference(first, again));
  }
  // What only remembers its last question has the same one to remember until others come between.
  const Exercise others(object, trial);
  static_cast<void>(others(object));
  const std::vector<double> after = exercise(object);
  require(same_bits(first, after), "asked again after something else, it answers otherwise: {}",
          first_difference(first, after));
  // What optimizers are asked has no order.
  const std::vector<double> backwards = object.optimizer ? first : exercise.backwards(object);
  require(same_bits(first, backwards), "asked in another order, it answers otherwise: {}",
          first_difference(first, backwards));
  const std::vector<double> other = exercise(trial.make());
  require(same_bits(first, other), "an object made of the same section answers otherwise: {}",
          first_difference(first, other));
}

void in_threads(Trial& trial)
{
  // A few calls hardly ever meet: quick ones are made for some time.
  constexpr int least_rounds = 4;
  constexpr std::chrono::milliseconds longest{20};
  const Object object = trial.make();
  if (object.optimizer && !object.optimizer->traits().thread_safe)
    skip("it does not declare itself thread safe: the program lets one run wait for another");
  // Two sets of questions: threads that keep step with the same one would overwrite each other with the same.
  const std::array<Exercise, 2> exercises{Exercise(object, trial), Exercise(object, trial)};
  const std::array<std::vector<double>, 2> alone{exercises[0](object), exercises[1](object)};
  std::vector<std::vector<double>> found(threads);
  std::vector<std::exception_ptr> thrown(threads);
  {
    std::vector<std::jthread> running;
    running.reserve(threads);
    for (std::size_t k = 0; k < threads; ++k) {
      running.emplace_back([&, k] {
        try {
          const auto end = std::chrono::steady_clock::now() + longest;
          for (int round = 0; round < least_rounds || std::chrono::steady_clock::now() < end; ++round) {
            found[k] = exercises[k % 2](object);
            if (!same_bits(alone[k % 2], found[k])) return;
          }
        } catch (...) {
          thrown[k] = std::current_exception();
        }
      });
    }
  }
  for (std::size_t k = 0; k < threads; ++k) {
    if (thrown[k]) std::rethrow_exception(thrown[k]);
    require(same_bits(alone[k % 2], found[k]), "called from {} threads at once, it answers otherwise: {}",
            threads, first_difference(alone[k % 2], found[k]));
  }
}

void floating_point(Trial& trial)
{
  const FloatingPointMode before = floating_point_mode();
  {
    const Object object = trial.make();
    const Exercise exercise(object, trial);
    static_cast<void>(exercise(object));  // the guard looks at every call
  }
  const FloatingPointMode after = floating_point_mode();
  require(after == before, "the floating-point mode was changed ({})", describe_change(before, after));
}

Check of_table(const char* name, const char* about, void (*function)(const PluginTable&))
{
  return {name, std::nullopt, about, [function](const PluginTable& table, const Setup&, std::uint64_t) {
            function(table);
            return Outcome{};
          }};
}

/// Whether the factory takes the section of a trial.
bool is_taken(const Trial& trial)
{
  Problems problems;
  try {
    static_cast<void>(trial.make(trial.section.values, problems));
  } catch (const InputError&) {
    return false;
  }
  return problems.empty();
}

/// One run of a check's function. Skip passes through.
Outcome attempt(Trial& trial, const std::function<void(Trial&)>& function)
{
  const auto where = [&] {
    return trial.looked_at.empty() ? std::string() : " (parameters: " + trial.looked_at + ")";
  };
  try {
    function(trial);
  } catch (const Skip&) {
    throw;
  } catch (const Slow& slow) {
    return {Outcome::Status::slow, slow.what() + where()};
  } catch (const NoParameters& error) {
    if (trial.switched) throw Skip(error.what());
    return {Outcome::Status::failed, error.what()};
  } catch (const std::exception& error) {
    return {Outcome::Status::failed, error.what() + where()};
  }
  return {};
}

/// The check with every switch of the section set otherwise, one at a time, until one fails.
Outcome with_switches(const PluginTable& table, const Section& base, std::uint64_t seed,
                      const std::function<void(Trial&)>& function)
{
  for (const Variant& variant : switched(base)) {
    Section section = base;
    section.values = variant.values;
    Trial trial(table, std::move(section), seed);
    trial.switched = true;
    if (!is_taken(trial)) continue;
    Outcome outcome;
    try {
      outcome = attempt(trial, function);
    } catch (const Skip&) {
      continue;
    }
    if (outcome.status == Outcome::Status::passed) continue;
    outcome.text += fmt::format(" (with {})", variant.field);
    return outcome;
  }
  return {};
}

}  // namespace

Check of_trial(std::string name, std::optional<PluginKind> kind, const char* about,
               std::function<void(Trial&)> function)
{
  return {std::move(name), kind, about,
          [kind, function = std::move(function)](const PluginTable& table, const Setup& setup,
                                                 std::uint64_t seed) {
            const Section section = read_section(table, setup);
            Trial trial(table, section, seed);
            Outcome outcome = attempt(trial, function);
            if (!kind || !setup.switches || outcome.status != Outcome::Status::passed) return outcome;
            return with_switches(table, section, seed, function);
          }};
}

void add_checks_of_every_kind(std::vector<Check>& out)
{
  out.push_back(of_table("descriptor", "id, version, summary and citation say something", descriptor));
  out.push_back(of_table("fields", "fields are well-formed, and defaults are within their bounds", fields));
  const auto add = [&](const char* name, const char* about, void (*function)(Trial&)) {
    out.push_back(of_trial(name, std::nullopt, about, function));
  };
  add("bad_values", "a value that is refused is refused by an error that names its field", bad_values);
  add_speed_check(out);
  add("instances", "objects do not influence each other", instances);
  add("repeatable", "the same question gets the same answer, to the bit", repeatable);
  add("threads", "several threads get the answers of one, to the bit", in_threads);
  add_process_checks(out);
  add("floating_point", "rounding, flush-to-zero and traps are left alone by every call", floating_point);
}

}  // namespace hauberk::conformance
