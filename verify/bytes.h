#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "maxwrench/types.h"

namespace maxwrench {

/// Writes numbers one after another, little endian.
class ByteWriter {
 public:
  void whole(std::uint64_t x, int bytes) {
    for (int i = 0; i < bytes; ++i) text_.push_back(static_cast<char>(x >> (8 * i) & 0xff));
  }
  void real(double x) { whole(Eigen::numext::bit_cast<std::uint64_t>(x), 8); }
  void count(Eigen::Index n) { whole(static_cast<std::uint64_t>(n), 8); }
  void words(const std::string& text) {
    count(static_cast<Eigen::Index>(text.size()));
    text_ += text;
  }
  template <class Derived>
  void matrix(const Eigen::MatrixBase<Derived>& M) {
    count(M.rows());
    count(M.cols());
    for (Eigen::Index j = 0; j < M.cols(); ++j) {
      for (Eigen::Index i = 0; i < M.rows(); ++i) real(M(i, j));
    }
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Reads these numbers again. After the end of the text it returns zero, and `good` is false.
class ByteReader {
 public:
  explicit ByteReader(std::string_view text) : text_(text) {}
  std::uint64_t whole(int bytes) {
    std::uint64_t x = 0;
    if (!has(static_cast<std::size_t>(bytes))) return 0;
    for (int i = 0; i < bytes; ++i) {
      const auto byte = static_cast<unsigned char>(text_[static_cast<std::size_t>(i)]);
      x |= static_cast<std::uint64_t>(byte) << (8 * i);
    }
    text_.remove_prefix(static_cast<std::size_t>(bytes));
    return x;
  }
  double real() { return Eigen::numext::bit_cast<double>(whole(8)); }
  /// The number of elements that follow, of at least `bytes` bytes each.
  std::size_t count(std::size_t bytes) {
    const std::uint64_t n = whole(8);
    good_ = good_ && n <= text_.size() / bytes;
    return good_ ? static_cast<std::size_t>(n) : 0;
  }
  std::string words() {
    const std::size_t n = count(1);
    const std::string text(text_.substr(0, n));
    text_.remove_prefix(n);
    return text;
  }
  Eigen::VectorXd vector() {
    Eigen::VectorXd v(static_cast<Eigen::Index>(count(sizeof(double))));
    good_ = whole(8) == 1 && good_;
    for (double& x : v) x = real();
    return v;
  }
  Eigen::MatrixXd matrix() {
    constexpr std::uint64_t kMost = 1U << 24U;  // the product of two does not overflow
    const std::uint64_t rows = whole(8), columns = whole(8);
    good_ = good_ && rows <= kMost && columns <= kMost &&
            rows * columns <= text_.size() / sizeof(double);
    if (!good_) return {};
    Eigen::MatrixXd M(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    for (double& x : M.reshaped()) x = real();
    return M;
  }
  bool good() const { return good_; }
  bool at_end() const { return good_ && text_.empty(); }

 private:
  bool has(std::size_t bytes) { return good_ = good_ && bytes <= text_.size(); }

  std::string_view text_;
  bool good_ = true;
};

}  // namespace maxwrench
