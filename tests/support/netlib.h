#pragma once

namespace maxwrench {

inline constexpr const char* kNetlibFolder = MAXWRENCH_SOURCE_DIR "/tests/data/netlib";

struct NetlibOptimum {
  const char* name;
  double value;
};

/// Koch (2004), "The final NETLIB-LP results", exact optima. That of e226 includes the constant
/// 7.113 that the objective's RHS entry of -7.113 stands for.
inline constexpr NetlibOptimum kNetlibOptima[] = {
    {"adlittle", 225494.96316238038}, {"afiro", -464.75314285714286},
    {"blend", -30.812149845828220},   {"brandy", 1518.5098964881284},
    {"capri", 2690.0129137681610},    {"degen2", -1435.178},
    {"e226", -11.638929066370549},    {"israel", -896644.82186304573},
    {"kb2", -1749.9001299062057},     {"recipe", -266.616},
    {"sc50a", -64.575077058564509},   {"sc50b", -70},
    {"scagr7", -2331389.824330984},   {"share2b", -415.73224074141949},
    {"stocfor1", -41131.976219436406}};

/// The infeasible programs.
inline constexpr const char* kNetlibInfeasible[] = {"itest2", "itest6",   "galenet",
                                                    "bgprtr", "woodinfe", "klein1"};

}  // namespace maxwrench
