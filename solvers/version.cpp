#include "maxwrench/version.h"

#include <fmt/format.h>

#include <Eigen/Core>

#if MAXWRENCH_WITH_CLP
#include <ClpConfig.h>
#endif
#if MAXWRENCH_WITH_GLPK
#include <glpk.h>
#endif
#if MAXWRENCH_WITH_IPOPT
#include <IpoptConfig.h>
#endif
#if MAXWRENCH_WITH_NLOPT
#include <nlopt.h>
#endif
#if MAXWRENCH_WITH_PAGMO
#include <pagmo/config.hpp>
#endif
#if MAXWRENCH_WITH_SUNDIALS
#include <sundials/sundials_version.h>
#endif

namespace maxwrench {
namespace {

/// The version of each library, as the library reports it at run time if it does.
std::string library_versions() {
  std::string text =
      fmt::format("Eigen {}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
#if MAXWRENCH_WITH_CLP
  text += ", Clp " CLP_VERSION;
#endif
#if MAXWRENCH_WITH_GLPK
  text += std::string(", GLPK ") + glp_version();
#endif
#if MAXWRENCH_WITH_IPOPT
  text += ", Ipopt " IPOPT_VERSION;
#endif
#if MAXWRENCH_WITH_NLOPT
  int major = 0, minor = 0, patch = 0;
  nlopt_version(&major, &minor, &patch);
  text += fmt::format(", NLopt {}.{}.{}", major, minor, patch);
#endif
#if MAXWRENCH_WITH_PAGMO
  text += ", pagmo " PAGMO_VERSION;
#endif
#if MAXWRENCH_WITH_SUNDIALS
  char sundials[40] = "";
  SUNDIALSGetVersion(sundials, sizeof(sundials));
  text += std::string(", SUNDIALS ") + sundials;
#endif
  return text;
}

}  // namespace

std::string describe_build() {
  return fmt::format("maxwrench {}\nsources {}\nbuild {}: {}\ncompiler {}\nlibraries {}\n",
                     version(), sources_id(), MAXWRENCH_BUILD, MAXWRENCH_FLAGS, __VERSION__,
                     library_versions());
}

}  // namespace maxwrench
