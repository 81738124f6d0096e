#include "tasks/sweep/row_lessons.hpp"

#include "limits/relatives.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {

std::vector<std::vector<std::size_t>> row_donors(const std::vector<RowScene>& rows)
{
  const std::size_t n = rows.size();
  std::vector<std::vector<std::size_t>> contained(n);
  const auto has = [&](std::size_t outer, std::size_t inner) {
    return contains(rows[outer]->model, rows[outer]->scene, rows[inner]->model, rows[inner]->scene);
  };
  for (std::size_t k = 0; k < n; ++k) {
    if (!rows[k] || !rows[k]->settings.lessons) continue;
    for (std::size_t j = 0; j < n; ++j) {
      if (j == k || !rows[j] || !has(k, j)) continue;
      if (j < k || !has(j, k)) contained[k].push_back(j);
    }
  }
  std::vector<std::vector<std::size_t>> donors(n);
  for (std::size_t k = 0; k < n; ++k) {
    std::copy_if(contained[k].begin(), contained[k].end(), std::back_inserter(donors[k]), [&](std::size_t j) {
      return std::none_of(contained[k].begin(), contained[k].end(), [&](std::size_t between) {
        return std::binary_search(contained[between].begin(), contained[between].end(), j);
      });
    });
  }
  return donors;
}

std::vector<std::vector<std::size_t>> row_rounds(const std::vector<std::vector<std::size_t>>& donors)
{
  std::vector<std::vector<std::size_t>> rounds;
  std::vector<bool> placed(donors.size(), false);
  for (std::size_t left = donors.size(); left > 0;) {
    std::vector<std::size_t> round;
    for (std::size_t k = 0; k < donors.size(); ++k) {
      if (!placed[k] &&
          std::all_of(donors[k].begin(), donors[k].end(), [&](std::size_t d) { return placed[d]; }))
        round.push_back(k);
    }
    for (const std::size_t k : round) placed[k] = true;
    left -= round.size();
    rounds.push_back(std::move(round));
  }
  return rounds;
}

std::vector<GivenState> given_by(const PreparedVariant& donor,
                                 const std::vector<std::optional<State>>& states,
                                 const PreparedVariant& learner, std::size_t donor_row)
{
  std::vector<GivenState> out;
  const Carrier carrier(donor.model, donor.scene, learner.model, learner.scene);
  if (!carrier.joined()) return out;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const std::optional<State> state = states[k] ? carrier.state(*states[k]) : std::nullopt;
    if (!state) continue;
    const LimitTask& task = donor.tasks[k];
    out.push_back({task.direction, task.sense, *state, fmt::format("row {}", donor_row)});
  }
  return out;
}

}  // namespace hauberk
