#include <unistd.h>

#include <CoinMpsIO.hpp>
#include <CoinPackedMatrix.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "maxwrench/mps.h"
#include "problems/mps/cards.h"

namespace maxwrench {
namespace {

/// Keeps the reader's first complaint instead of printing it.
class Quiet final : public CoinMessageHandler {
 public:
  int print() override {
    if (first.empty() && currentMessage().severity() != 'I') first = messageBuffer();
    return 0;
  }
  CoinMessageHandler* clone() const override { return new Quiet(*this); }
  std::string first;
};

/// CoinMpsIO reads files only.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text) {
    path = (std::filesystem::temp_directory_path() / "maxwrench-mps-XXXXXX").string();
    const int descriptor = mkstemp(path.data());
    if (descriptor < 0) throw std::runtime_error("cannot create " + path);
    close(descriptor);
    std::ofstream out(path);
    out << text;
    out.close();
    if (out) return;
    unlink(path.c_str());
    throw std::runtime_error("cannot write " + path);
  }
  ~TemporaryFile() { unlink(path.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  std::string path;
};

double to_infinity(const CoinMpsIO& reader, double bound) {
  if (bound >= reader.getInfinity()) return kInfinity;
  return bound <= -reader.getInfinity() ? -kInfinity : bound;
}

void read(const std::string& path, const std::string& text, CoinMpsIO& reader) {
  Quiet quiet;
  quiet.setLogLevel(1);
  reader.passInMessageHandler(&quiet);
  reader.setSmallElementValue(0);
  const TemporaryFile file(text);
  const int errors = reader.readMps(file.path.c_str(), "");
  int crossing = 0;  // counted as errors, but they are merely infeasible
  for (int j = 0; errors > 0 && errors < 100000 && j < reader.getNumCols(); ++j) {
    crossing += reader.getColLower()[j] > reader.getColUpper()[j];
  }
  if (errors < 0 || errors > crossing) {
    throw std::invalid_argument(path +
                                ": expected an MPS file without contradictions: " + quiet.first);
  }
}

LinearProgram to_program(const CoinMpsIO& reader, bool minimize) {
  const int m = reader.getNumRows(), n = reader.getNumCols();
  LinearProgram p;
  std::vector<Eigen::Triplet<double>> entries;
  const CoinPackedMatrix& matrix = *reader.getMatrixByCol();
  for (int j = 0; j < n; ++j) {
    const CoinBigIndex begin = matrix.getVectorStarts()[j];
    for (CoinBigIndex k = begin; k < begin + matrix.getVectorLengths()[j]; ++k) {
      entries.emplace_back(matrix.getIndices()[k], j, matrix.getElements()[k]);
    }
    p.col_names.emplace_back(reader.columnName(j));
  }
  p.b.setZero(m);
  std::vector<double> l(reader.getColLower(), reader.getColLower() + n);
  std::vector<double> u(reader.getColUpper(), reader.getColUpper() + n);
  for (int i = 0; i < m; ++i) {
    p.row_names.emplace_back(reader.rowName(i));
    const double low = reader.getRowLower()[i], high = reader.getRowUpper()[i];
    if (low == high) {
      p.b[i] = low;
      continue;
    }
    entries.emplace_back(i, static_cast<int>(l.size()), -1.0);
    l.push_back(low);
    u.push_back(high);
    p.col_names.push_back(p.row_names.back());
  }
  const int cols = static_cast<int>(l.size());
  p.A.resize(m, cols);
  p.A.setFromTriplets(entries.begin(), entries.end());
  p.l.resize(cols);
  p.u.resize(cols);
  p.c.setZero(cols);
  for (int j = 0; j < cols; ++j) {
    p.l[j] = to_infinity(reader, l[j]);
    p.u[j] = to_infinity(reader, u[j]);
    if (j < n) p.c[j] = (minimize ? -1 : 1) * reader.getObjCoefficients()[j];
  }
  return p;
}

}  // namespace

MpsProgram read_mps(const std::string& path) {
  const mps::Cards cards(path);
  CoinMpsIO reader;
  read(path, cards.text(), reader);
  MpsProgram result;
  result.program = to_program(reader, cards.minimize);
  result.name = cards.name;
  result.objective_name = reader.getObjectiveName();
  result.minimize = cards.minimize;
  result.constant = 0 - reader.objectiveOffset();
  result.file_cols = reader.getNumCols();
  return result;
}

}  // namespace maxwrench
