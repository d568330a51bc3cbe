// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/blas_kernels.h>

#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <vector>

// Functions of OpenBLAS, whose header has different names.
extern "C" void openblas_set_num_threads(int n_threads);
extern "C" char *openblas_get_corename();

namespace quoin
{
  namespace
  {
    constexpr const char *fallback = "Prescott";

    bool has_fallback()
    {
      return std::strcmp(openblas_get_corename(), fallback) == 0;
    }

    /** Kernels of OpenBLAS for what the processor can do, the fastest first. */
    std::vector<const char *> known_kernels()
    {
      std::vector<const char *> kernels;
#if defined(__x86_64__)
      if (__builtin_cpu_supports("avx512f")
          && __builtin_cpu_supports("avx512bw")
          && __builtin_cpu_supports("avx512dq")
          && __builtin_cpu_supports("avx512vl"))
        kernels.push_back("SkylakeX");
      if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        kernels.push_back("Haswell");
#endif
      return kernels;
    }

    /** Lets OpenBLAS choose anew, where it has kernels to choose from. */
    void choose_anew()
    {
      using Function   = void (*)();
      const auto found = [](const char *name)
      { return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name)); };
      const Function quit  = found("gotoblas_dynamic_quit"),
                     begin = found("gotoblas_dynamic_init");
      if (!quit || !begin)
        return;
      quit();
      begin();
    }
  } // namespace

  void choose_blas_kernels()
  {
    openblas_set_num_threads(1);
    const char *wanted = "OPENBLAS_CORETYPE";
    if (std::getenv(wanted))
      return;
    for (const char *kernels : known_kernels())
    {
      if (!has_fallback())
        break;
      setenv(wanted, kernels, 1);
      choose_anew();
    }
    // Nothing that this process starts is to depend on it.
    unsetenv(wanted);
  }
} // namespace quoin
