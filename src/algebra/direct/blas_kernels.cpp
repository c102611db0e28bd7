#include "algebra/direct/blas_kernels.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <string_view>

extern "C" char* openblas_get_corename();

namespace dotyk::algebra {
namespace {

/// OpenBLAS's name of the best kernels for this processor; null where it has no AVX2.
const char* kernels_by_features() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
  return nullptr;
}

}  // namespace

void choose_blas_kernels() {
  constexpr const char* kVariable = "OPENBLAS_CORETYPE";
  const char* better = kernels_by_features();
  if (!better || std::getenv(kVariable) || std::string_view(openblas_get_corename()) != "Prescott") return;
  // What OpenBLAS does when it is loaded and unloaded: not in its header.
  const auto leave = reinterpret_cast<void (*)()>(dlsym(RTLD_DEFAULT, "gotoblas_dynamic_quit"));
  const auto choose = reinterpret_cast<void (*)()>(dlsym(RTLD_DEFAULT, "gotoblas_dynamic_init"));
  if (!leave || !choose) return;
  setenv(kVariable, better, 1);
  leave(), choose();
  unsetenv(kVariable);
}

}  // namespace dotyk::algebra
