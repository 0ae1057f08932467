// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_tests_scene_support_h
#define touchstone_tests_scene_support_h

#include <touchstone/base/input_error.h>
#include <touchstone/scene/scene.h>

#include <iostream>
#include <sstream>

/** A scene of two blocks in which nothing is wrong. */
inline const std::string good_scene = R"(
set Title         = Two blocks
set Bodies        = lower, upper
set Obstacles     = floor
set Contact pairs = between, below

subsection Body lower
  set Boundary conditions = right
  subsection Geometry
    set Type = box
  end
  subsection Material
    set Young modulus = 210000
  end
  subsection Boundary right
    set Pressure = 5*t
  end
end

subsection Body upper
  set Fixed = top
  subsection Geometry
    set Type = box
  end
  subsection Material
    set Young modulus = 1e3
    set Poisson ratio = 0.2
  end
end

subsection Obstacle floor
  set Point    = 0, 0, -0.1
  set Motion z = 0.2*t
end

subsection Contact pair between
  set Slave body        = lower
  set Slave boundaries  = top
  set Master body       = upper
  set Master boundaries = bottom
end

subsection Contact pair below
  set Slave body       = lower
  set Slave boundaries = bottom
  set Obstacle         = floor
end
)";

/** The text with @p from replaced by @p to, which must occur. */
inline std::string
replaced(std::string text, const std::string &from, const std::string &to)
{
  const std::size_t position = text.find(from);
  if (position == std::string::npos)
    throw std::logic_error("the test looks for what is not there: " + from);
  return text.replace(position, from.size(), to);
}

/** Print what the program has to say to a scene. */
inline void
try_scene(const std::string              &what,
          const std::string              &text,
          const std::vector<std::string> &overrides = {})
{
  std::cout << "* " << what << '\n';
  try
    {
      const Touchstone::Scene scene(text, "scene.prm", overrides);
      std::cout << "  accepted" << std::endl;
      for (const std::string &sentence : scene.without_effect)
        std::cout << "  " << sentence << std::endl;
    }
  catch (const Touchstone::InputError &error)
    {
      std::cout << "  " << error.what() << std::endl;
    }
}

/** Print what the program has to say to the good scene with one change. */
inline void
try_change(const std::string &what, const std::string &from, const std::string &to)
{
  try_scene(what, replaced(good_scene, from, to));
}

/** Print what the program has to say to overrides of the good scene. */
inline void
try_override(const std::string &what, const std::vector<std::string> &overrides)
{
  try_scene(what, good_scene, overrides);
}

#endif
