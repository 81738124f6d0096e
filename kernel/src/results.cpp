#include <hauberk/results.hpp>

namespace hauberk {

std::string to_string(LimitStatus status)
{
  switch (status) {
    case LimitStatus::locked:
      return "locked";
    case LimitStatus::unbounded:
      return "unbounded";
    case LimitStatus::not_attained:
      return "not_attained";
    case LimitStatus::stalled:
      return "stalled";
    case LimitStatus::failed:
      return "failed";
    case LimitStatus::interrupted:
      return "interrupted";
  }
  return "failed";
}

}  // namespace hauberk
