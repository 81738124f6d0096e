#include "limits/limit_result.hpp"

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
    case LimitStatus::not_a_sheet:
      return "not_a_sheet";
  }
  return "failed";
}

bool is_answer(LimitStatus status)
{
  return status == LimitStatus::locked || status == LimitStatus::unbounded ||
         status == LimitStatus::not_attained || status == LimitStatus::not_a_sheet;
}

}  // namespace hauberk
