#pragma once
/// Rows of a sweep that contain each other learn from each other: what a row with more clearance, with more
/// held, or of a smaller cell locks in is a state of the row that contains it.

#include "run/variant_run.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace hauberk {

/// A row's scene; null: it is none.
using RowScene = std::optional<PreparedVariant>;

/// For every row those whose states it begins from: of the rows that it contains the ones that no other of
/// them contains. Of rows that contain each other the later one learns. So there are no circles.
std::vector<std::vector<std::size_t>> row_donors(const std::vector<RowScene>& rows);

/// Rows by rounds: all donors of a row are in rounds before its own.
std::vector<std::vector<std::size_t>> row_rounds(const std::vector<std::vector<std::size_t>>& donors);

/// The locked states of a row's tasks, as another one that contains it takes them.
std::vector<GivenState> given_by(const PreparedVariant& donor,
                                 const std::vector<std::optional<State>>& states,
                                 const PreparedVariant& learner, std::size_t donor_row);

}  // namespace hauberk
