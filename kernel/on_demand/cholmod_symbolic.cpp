#include "numerics/symbolic_factor.hpp"

#include <cholmod.h>

#include <memory>
#include <mutex>
#include <new>

namespace hauberk {
namespace {

/// CHOLMOD's workspace and settings.
class Workspace {
 public:
  Workspace()
  {
    cholmod_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.print = 0;
    common_.error_handler = nullptr;
  }
  ~Workspace() { cholmod_finish(&common_); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  cholmod_common* operator&() { return &common_; }
  cholmod_common* operator->() { return &common_; }

 private:
  cholmod_common common_{};
};

/// Its view of the pattern of a lower triangle.
cholmod_sparse view(int n, const int* columns, const int* rows)
{
  cholmod_sparse a{};
  a.nrow = a.ncol = static_cast<std::size_t>(n);
  a.nzmax = static_cast<std::size_t>(columns[n]);
  // Read only; the interface has no const.
  a.p = const_cast<int*>(columns);
  a.i = const_cast<int*>(rows);
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_PATTERN;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = 1;
  a.packed = 1;
  return a;
}

bool find(int n, const int* columns, const int* rows, const int* given, SymbolicFactor& out)
{
  Workspace common;
  cholmod_sparse a = view(n, columns, rows);
  if (given != nullptr) {
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_GIVEN;
  }
  const auto release = [&common](cholmod_factor* f) { cholmod_free_factor(&f, &common); };
  std::unique_ptr<cholmod_factor, decltype(release)> symbolic(nullptr, release);
  {
    // METIS, which CHOLMOD tries where minimum degree leaves much to do, draws random numbers of one
    // generator for the whole process. It seeds it anew each time, so one call at a time is reproducible.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    symbolic.reset(cholmod_analyze_p(&a, const_cast<int*>(given), nullptr, 0, &common));
  }
  if (!symbolic) return false;
  const auto ints = [](const void* p) { return static_cast<const int*>(p); };
  out.order.assign(ints(symbolic->Perm), ints(symbolic->Perm) + symbolic->n);
  out.first.assign(ints(symbolic->super), ints(symbolic->super) + symbolic->nsuper + 1);
  out.begin.assign(ints(symbolic->pi), ints(symbolic->pi) + symbolic->nsuper + 1);
  out.rows.assign(ints(symbolic->s), ints(symbolic->s) + out.begin.back());
  return true;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) bool hauberk_symbolic_factor(int n, const int* columns,
                                                                               const int* rows,
                                                                               const int* given,
                                                                               SymbolicFactor& out)
{
  try {
    return find(n, columns, rows, given, out);
  } catch (const std::bad_alloc&) {
    return false;
  }
}

}  // namespace hauberk
