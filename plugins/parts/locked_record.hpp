#pragma once
/// What a search came to, as a record (document/record_line.hpp).

#include "document/record_line.hpp"
#include "equilibrium/locking.hpp"

namespace hauberk {

/// Whether a record holds all of it. Not of what has second derivatives of its contacts, which no search
/// keeps.
bool is_recordable(const Locked& locked);

/// All of it, to the bit, but for what never changes a result: threads, and whom to ask whether to go on.
void write_locked(const Locked& locked, RecordWriter& out);

/// The same from a record. Where `in` turns bad it is of no use.
Locked read_locked(RecordReader& in);

}  // namespace hauberk
