#pragma once
/// What limits inherit: each begins once more from where the same limit locks in every scene that its own
/// contains (relatives.hpp). Those scenes have lessons and company as by themselves, and of the searches from
/// rest a share (rest_searches.hpp), those with fewer elements all of them.

#include "limits/limits.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// The scenes that one contains, and those that they contain, each once, for some of its limits: those that
/// may fold and taut ones that begin again (donors.hpp) inherit. Keeps no state; what is passed outlives it.
/// Thread safe.
class ScenesWithin {
 public:
  /// Of `tasks` the first `asked` inherit. Of the observer `keep_going`, `on_start` and `memory` are used.
  ScenesWithin(const Model& model, const SceneSpec& spec, const std::vector<LimitTask>& tasks,
               std::size_t asked, const LimitSettings& settings, const LimitsObserver& observer);

  bool inherits(std::size_t task) const;

  /// The states that the scenes within lock in, carried over; none of those whose rests are not joined. Adds
  /// every limit that was solved for them to `solved`.
  std::vector<GivenState> states(unsigned threads, std::vector<LimitResult>& solved) const;

  /// The searches there that stand alone, a share of them for the memory (compute_searches). Returns how many
  /// all of them are.
  std::size_t search(unsigned threads, const Share& share) const;

 private:
  struct Scene;
  /// One that contains others.
  struct Outer {
    std::string name;  ///< empty: the outermost
    const Model& model;
    const SceneSpec& spec;
    std::shared_ptr<const LoadCase> load;
    std::vector<LimitTask> tasks;  ///< that inherit
    std::optional<State> start;
  };

  bool going() const { return !observer_.keep_going || observer_.keep_going(); }
  std::vector<Scene> all(std::vector<std::size_t>& own) const;
  std::vector<std::size_t> enter(const Outer& outer, std::vector<Scene>& scenes) const;
  static void give(const Scene& from, const Model& to, const SceneSpec& spec, std::vector<GivenState>& out);

  const Model& model_;
  const SceneSpec& spec_;
  const std::vector<LimitTask>& tasks_;
  std::size_t asked_;
  const LimitSettings& settings_;
  const LimitsObserver& observer_;
};

}  // namespace hauberk
