// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exact_sum.h>

#include <cmath>
#include <limits>

// Exact sums: a number is cut into three digits of 32 bits at fixed places, and digits are added as
// integers, which is associative. Ranks add their digits; only the last conversion rounds.
namespace Touchstone
{
  void
  ExactSum::add(const double value)
  {
    if (!std::isfinite(value))
      {
        ++n_invalid;
        return;
      }
    if (value == 0.)
      return;
    int        exponent;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    const unsigned int place = exponent - 53 - lowest, digit = place / 32, shift = place % 32;
    // 53 bits from the place on, which is within a digit: up to 85 bits, in three digits.
    const bool          negative  = mantissa < 0;
    const std::uint64_t magnitude = negative ? -mantissa : mantissa;
    const std::uint64_t low = (magnitude & 0xffffffffU) << shift, high = (magnitude >> 32) << shift;
    const std::int64_t  parts[3] = {static_cast<std::int64_t>(low & 0xffffffffU),
                                    static_cast<std::int64_t>((low >> 32) + (high & 0xffffffffU)),
                                    static_cast<std::int64_t>(high >> 32)};
    for (unsigned int i = 0; i < 3; ++i)
      digits[digit + i] += negative ? -parts[i] : parts[i];
    // A part has up to 33 bits.
    if (++additions >= most_additions / 4)
      carry();
  }



  void
  ExactSum::add(const ExactSum &other)
  {
    ExactSum carried(other);
    carried.carry();
    carry();
    for (unsigned int i = 0; i < n_digits; ++i)
      digits[i] += carried.digits[i];
    n_invalid += other.n_invalid;
    carry();
  }



  void
  ExactSum::carry()
  {
    for (unsigned int i = 0; i + 1 < n_digits; ++i)
      {
        // An arithmetic shift: rounds down, so that the rest is not negative.
        const std::int64_t over = digits[i] >> 32;
        digits[i] -= over * (std::int64_t(1) << 32);
        digits[i + 1] += over;
      }
    additions = 1;
  }



  double
  ExactSum::value() const
  {
    if (n_invalid > 0)
      return std::numeric_limits<double>::quiet_NaN();
    ExactSum positive(*this);
    positive.carry();
    const bool negative = positive.digits.back() < 0;
    if (negative)
      {
        for (std::int64_t &digit : positive.digits)
          digit = -digit;
        positive.carry();
      }
    // The digits are unique now. From the highest one down: three of them hold the 53 bits that
    // count, and what is below changes the last bit at most.
    double       result = 0.;
    unsigned int used   = 0;
    for (unsigned int i = n_digits; i-- > 0 && used < 4;)
      if (positive.digits[i] != 0 || used > 0)
        {
          result += std::ldexp(static_cast<double>(positive.digits[i]), lowest + 32 * int(i));
          ++used;
        }
    return negative ? -result : result;
  }



  double
  ExactSum::value(const MPI_Comm communicator) const
  {
    ExactSum all(*this);
    all.carry();
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      {
        // Digits below 2^32 of up to 2^31 ranks do not overflow.
        std::array<std::int64_t, n_digits + 1> mine, sum;
        std::copy(all.digits.begin(), all.digits.end(), mine.begin());
        mine.back() = all.n_invalid;
        const int error =
          MPI_Allreduce(mine.data(), sum.data(), mine.size(), MPI_INT64_T, MPI_SUM, communicator);
        AssertThrowMPI(error);
        std::copy(sum.begin(), sum.end() - 1, all.digits.begin());
        all.n_invalid = sum.back();
      }
    return all.value();
  }
} // namespace Touchstone
