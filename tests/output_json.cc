// SPDX-License-Identifier: LGPL-2.1-or-later
// The JSON writer: order, escapes, digits, what is not a number.

#include <touchstone/output/json.h>

#include <iostream>
#include <limits>

using namespace Touchstone;

int
main()
{
  Json object = Json::object();
  object.set("text", "quote \" backslash \\ line\nbreak tab\t bell \a umlaut ü")
    .set("third", 1. / 3.)
    .set("tiny", 1e-300)
    .set("integer", 201586)
    .set("large integer", std::numeric_limits<std::uint64_t>::max())
    .set("negative", -7)
    .set("true", true)
    .set("nan", std::numeric_limits<double>::quiet_NaN())
    .set("infinity", -std::numeric_limits<double>::infinity())
    .set("null", Json())
    .set("replaced", 1)
    .set("vector", dealii::Tensor<1, 3>({1., -2.5, 1e-20}))
    .set("empty object", Json::object())
    .set("empty array", Json::array())
    .set("objects",
         Json::array().append(Json::object().set("a", 1)).append(Json::array().append(2)));
  object.set("replaced", 2);
  std::cout << object.print() << Json(1. / 3.).print(4);
  return 0;
}
