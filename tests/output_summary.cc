// SPDX-License-Identifier: LGPL-2.1-or-later
// summary.json, and the text of the results that tests compare.

#include <touchstone/output/summary.h>

#include <cmath>
#include <iostream>

using namespace Touchstone;

int
main()
{
  RunSummary summary;
  summary.title      = "A \"press\" fit";
  summary.version    = "0.1.0";
  summary.converged  = true;
  summary.ranks      = 2;
  summary.cells      = 4608;
  summary.unknowns   = 34986;
  summary.steps      = 4;
  summary.iterations = {17, 5, 0, 320, 18.8235294117647};
  summary.counts     = {1, 17, 2, 17};
  summary.seconds    = {1.5, 2.75, 0.25, 0.5, 0.125, 0.0625};

  summary.peak_memory_mb = 512.25;
  summary.balance        = {{"cells", {2304., 2400.}}, {"slave_rows", {0., 0.}}};

  PairResult pair;
  pair.force           = dealii::Tensor<1, dim>({1234.56789, -2.0000004, 3e-9});
  pair.moment          = dealii::Tensor<1, dim>({-1e-12, 0.125, -5000.});
  pair.area            = 0.3926990817;
  pair.max_pressure    = 54.0934;
  pair.max_penetration = 3e-13;
  pair.active          = 343;

  summary.contact["joint"]           = pair;
  summary.contact["never touched"]   = PairResult();
  summary.reactions["inner"]["left"] = dealii::Tensor<1, dim>({-1234.56789, 1e-7, 2.});
  summary.reactions["inner"]["top"]  = dealii::Tensor<1, dim>({0., -1e-14, 0.});
  summary.errors["contact_pressure"] = 2.123456789e-4;
  summary.errors["exact"]            = 4e-15;
  summary.errors["unknown"]          = std::nan("");

  std::cout << summary.to_json().print() << summary.balance_line() << '\n';
  summary.print_results(std::cout);

  // Round-off of another solver or number of ranks must not show.
  summary.contact["joint"].force += dealii::Tensor<1, dim>({1e-7, 1e-8, -1e-7});
  summary.contact["joint"].max_penetration = 8e-12;
  std::cout << '\n';
  summary.print_results(std::cout);

  RunSummary failed;
  failed.failure = "Step 1 did not converge after 8 cuts.";
  std::cout << '\n';
  failed.print_results(std::cout);
  return 0;
}
