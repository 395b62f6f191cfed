// Solves random linear complementarity problems with the engine's own code and with ours, and compares them bit by bit.
//
//   lcp COUNT
//
// prints "equal N given-up N different N rows N": problems that both solved with the same bits, that both gave up, those
// where they differ, and the rows of all of them. The problems have rows without bounds, with one, with two, and friction;
// matrices of full and of lower rank, some with numbers of few digits, so that steps have the same length.

#include <dart/external/odelcpsolver/lcp.h>
#include <iostream>
#include <limits>
#include <random>
#include <string>

#include "contact/dantzig_lcp.hpp"

namespace {

using Matrix = pydart2::DantzigLcp::Matrix;

struct Problem
{
  Matrix A;
  Eigen::VectorXd b, lo, hi, x;
  Eigen::VectorXi findex;
};

Problem random_problem(std::mt19937& random)
{
  const auto integer = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const bool few_digits = integer(0, 3) == 0;
  const auto number = [&] {
    const double value = std::normal_distribution<double>()(random);
    return few_digits ? std::round(2.0 * value) / 2.0 : value;
  };
  const int size = integer(1, 100), rank = integer(1 + size / 3, size + 4);
  const double infinity = std::numeric_limits<double>::infinity(), mixing = integer(0, 2) == 0 ? 1e-1 : 1e-5;
  Problem problem;
  const Matrix rows = Matrix::NullaryExpr(size, rank, [&] { return integer(0, 2) == 0 ? 0.0 : number(); });
  problem.A.setZero(size, dPAD(size));
  problem.A.leftCols(size) = rows * rows.transpose();
  problem.A.diagonal().array() += mixing;
  problem.b = Eigen::VectorXd::NullaryExpr(size, number);
  problem.x.setZero(size);
  problem.lo.setConstant(size, 0.0);
  problem.hi.setConstant(size, infinity);
  problem.findex.setConstant(size, -1);
  for (int row = 0; row < size; ++row)
    switch (integer(0, 4)) {
      case 0: // a joint that holds
        problem.lo[row] = integer(0, 1) == 0 ? -infinity : 0.0;
        break;
      case 1: // a motor
        problem.hi[row] = std::abs(number());
        problem.lo[row] = -problem.hi[row];
        break;
      case 2: // an upper limit
        problem.lo[row] = -infinity;
        problem.hi[row] = 0.0;
        break;
      default: // a contact
        for (int friction = row + 1; friction < std::min(size, row + 3); ++friction) {
          problem.findex[friction] = row;
          problem.hi[friction] = 0.7;
          problem.lo[friction] = -0.7;
        }
        row += 2;
    }
  return problem;
}

} // namespace

int main(int, char** argv)
{
  std::mt19937 random(1);
  pydart2::DantzigLcp ours;
  int equal = 0, given_up = 0, different = 0;
  long rows = 0;
  for (int i = 0; i < std::stoi(argv[1]); ++i) {
    Problem a = random_problem(random), b = a;
    const auto size = static_cast<int>(a.x.size());
    const bool solved = dart::external::ode::dSolveLCP(
        size, a.A.data(), a.x.data(), a.b.data(), nullptr, 0, a.lo.data(), a.hi.data(), a.findex.data(), true);
    const bool we_solved = ours.solve(b.A, b.x, b.b, b.lo, b.hi, b.findex);
    if (solved != we_solved || (solved && a.x != b.x))
      ++different;
    else
      ++(solved ? equal : given_up);
    rows += size;
  }
  std::cout << "equal " << equal << " given-up " << given_up << " different " << different << " rows " << rows << "\n";
}
