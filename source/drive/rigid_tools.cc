// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/rigid_tools.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Where obstacles that forces move are in an implicit step (doc/theory.md 4.5). Their balance is in
// rigid_tools_balance.cc; what is kept of a step, and how a run begins, in rigid_tools_history.cc.
namespace Touchstone
{
  using namespace dealii;

  RigidTools::Components
  RigidTools::motion_of(const unsigned int tool) const
  {
    Components motion{};
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      if (unknowns[k].tool == tool)
        motion[unknowns[k].component] = broyden.x()[k] / unknowns[k].scale;
    return motion;
  }



  void
  RigidTools::place()
  {
    for (unsigned int k = 0; k < tools.size(); ++k)
      {
        RigidTool::move(tools[k].present, tools[k].committed, motion_of(k));
        tools[k].place(tools[k].present);
      }
  }



  void
  RigidTools::begin_step(const double t)
  {
    if (tools.empty())
      return;
    time = t;
    step = time - committed_time;
    // Inertia is a part of what the inverse is of.
    if (scheme && std::abs(step - committed_step) > 1e-9 * step)
      broyden.inverse.assign(broyden.inverse.size(), 0.);
    else
      broyden.inverse = committed_inverse;
    const std::size_t n = unknowns.size();
    Numbers           x(n);
    if (!guess.empty())
      x = guess;
    else if (scheme)
      // As the nodes, in free flight.
      for (std::size_t k = 0; k < n; ++k)
        {
          const RigidTool::State &state = tools[unknowns[k].tool].committed;
          Tensor<1, dim>          omega;
          for (unsigned int d = 0; d < dim; ++d)
            omega[d] = state.velocity[dim + d];
          omega                = state.turn * omega;
          const unsigned int c = unknowns[k].component;
          x[k] = step * (c < dim ? state.velocity[c] : omega[c - dim]) * unknowns[k].scale;
        }
    else if (!broyden.inverse.empty())
      for (std::size_t k = 0; k < n; ++k)
        {
          const RigidTool   &tool = tools[unknowns[k].tool];
          const unsigned int c    = unknowns[k].component;
          const double change     = (tool.load(t)[c] - tool.committed.load[c]) / unknowns[k].scale;
          for (std::size_t i = 0; i < n; ++i)
            x[i] += broyden.inverse[i * n + k] * change;
        }
    guess.clear();
    approaches = 0;
    broyden.begin(x);
    place();
  }



  double
  RigidTools::way_to_touch(const RigidTool &tool, const Components &direction) const
  {
    Tensor<1, dim> shift, turn;
    for (unsigned int d = 0; d < dim; ++d)
      {
        shift[d] = direction[d];
        turn[d]  = direction[dim + d];
      }
    const Point<dim> centre = tool.centre(time);
    double           least  = std::numeric_limits<double>::max();
    for (const unsigned int p : tool.pairs())
      for (const ContactRow &row : contact.pair(p).rows())
        if (row.has_partner)
          {
            const Tensor<1, dim> way =
              shift + cross_product_3d(turn, Tensor<1, dim>(contact_point(row) - centre));
            // Nearly along the surface obstacles do not come to a body.
            constexpr double along = 1e-6;
            if (const double closing = way * row.normal; closing > along * way.norm())
              least = std::min(least, row.gap / closing);
          }
    return Utilities::MPI::min(least, contact.communicator());
  }



  double
  RigidTools::loose_force(const unsigned int             t,
                          const Numbers                 &residual,
                          const double                   scale,
                          const std::vector<PairResult> &results) const
  {
    for (const unsigned int p : tools[t].pairs())
      if (results[p].active > 0)
        return 0.;
    double force = 0.;
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      if (unknowns[k].tool == t)
        force = std::hypot(force, residual[k]);
    return force > 1e-8 * scale ? force : 0.;
  }



  double
  RigidTools::way_along_load(const unsigned int t,
                             const Numbers     &residual,
                             const double       force) const
  {
    Components direction{};
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      if (unknowns[k].tool == t)
        direction[unknowns[k].component] = -residual[k] / (force * unknowns[k].scale);
    return way_to_touch(tools[t], direction);
  }



  bool
  RigidTools::approach(const Numbers                 &residual,
                       const double                   scale,
                       const std::vector<PairResult> &results)
  {
    constexpr unsigned int most  = 20;
    Numbers                x     = broyden.x();
    bool                   moved = false;
    for (unsigned int t = 0; t < tools.size(); ++t)
      if (const double force = loose_force(t, residual, scale, results); force > 0.)
        {
          const RigidTool &tool = tools[t];
          const double     way  = way_along_load(t, residual, force);
          if (way == std::numeric_limits<double>::max() || approaches >= most)
            throw NothingResists("the load moves the obstacle '" + tool.name() +
                                 "' to where it touches nothing: no force holds it");
          // So far that a force arises.
          const double further =
            std::min(force / (tool.modulus() * tool.face()), 0.1 * tool.face());
          for (std::size_t k = 0; k < unknowns.size(); ++k)
            if (unknowns[k].tool == t)
              x[k] -= (way + further) * residual[k] / force;
          moved = true;
        }
    approaches += moved;
    if (moved)
      broyden.jump(x);
    return moved;
  }



  void
  RigidTools::return_to_touch(const Numbers                 &residual,
                              const double                   scale,
                              const std::vector<PairResult> &results)
  {
    // Forces do not change across a gap. Where it closes they are the same, and what they have
    // changed by on the way to there is the stiffness of the contact that was lost.
    Numbers x = broyden.x();
    for (unsigned int t = 0; t < tools.size(); ++t)
      if (const double force = loose_force(t, residual, scale, results); force > 0.)
        if (const double way = way_along_load(t, residual, force);
            way < std::numeric_limits<double>::max())
          for (std::size_t k = 0; k < unknowns.size(); ++k)
            if (unknowns[k].tool == t)
              x[k] -= way * residual[k] / force;
    broyden.move(x);
  }



  bool
  RigidTools::correct(const Vector &u)
  {
    if (tools.empty())
      return false;
    const auto     results = pair_results(contact, u);
    const Residual found   = residual(results);
    const auto     bad     = worst(found);
    if (!bad)
      return false;
    const unsigned int most = 30 + 10 * unknowns.size();
    if (broyden.n_changes() >= most)
      {
        const double part = std::abs(found.missing[*bad]) / found.largest;
        throw NotBalanced("the obstacle '" + tools[unknowns[*bad].tool].name() +
                            "' does not come to balance along '" +
                            FreeMotionParameters::word(unknowns[*bad].component) + "': " +
                            Patterns::Tools::to_string(part) + " of the largest force is missing",
                          // Far from balance what is missing is itself the largest force, whatever
                          // the step.
                          std::abs(found.missing[*bad]) /
                            (found.of_loads > 0. ? found.of_loads : found.largest));
      }
    if (!scheme && broyden.n_changes() == 0 && approach(found.missing, found.largest, results))
      {
        place();
        return true;
      }
    if (!scheme && !broyden.in_differences())
      return_to_touch(found.missing, found.largest, results);
    const Numbers stiff = stiffness(results);
    // Far away, where all nodes slide, the chord of their way, not the way, gives friction its
    // direction, and there are other balances.
    bool   friction = false;
    double motion = 0., soft = std::numeric_limits<double>::max();
    for (const RigidTool &tool : tools)
      {
        soft = std::min(soft, tool.modulus() * tool.face());
        for (const unsigned int p : tool.pairs())
          friction = friction || contact.pair(p).parameters().friction;
      }
    // No change is larger than what the forces would move the obstacle by, or than the motion so
    // far: where contact closes or opens, stiffness says little farther away.
    for (const double x : broyden.x())
      motion = std::hypot(motion, x);
    const double stiffness = *std::min_element(stiff.begin(), stiff.end());
    double       by_forces = found.largest / stiffness;
    if (!friction)
      by_forces = 10. * std::max(scheme ? by_forces : 0., found.largest / soft);
    if (const auto direction =
          broyden.advance(found.missing,
                          {stiff, found.of_bodies, std::max(motion, by_forces), friction}))
      give_up(*direction, results);
    place();
    return true;
  }



  void
  RigidTools::give_up(const Numbers &direction, const std::vector<PairResult> &results) const
  {
    // Where all nodes slide, friction does not change with the motion of the obstacle. It could
    // hold what it is larger than: then the bodies have moved too far in this step, as below a
    // roller that they turn, and nodes stick in a shorter one. Loads beyond it have no equilibrium.
    double       load = 0., of_bodies = 0.;
    unsigned int slides = 0;
    for (std::size_t k = 0; k < direction.size(); ++k)
      {
        const RigidTool   &tool = tools[unknowns[k].tool];
        const unsigned int c    = unknowns[k].component;
        load += direction[k] * tool.present.load[c] / unknowns[k].scale;
        of_bodies += direction[k] * tool.present.contact[c] / unknowns[k].scale;
        for (const unsigned int p : tool.pairs())
          slides += results[p].slip;
      }
    if (slides > 0 && std::abs(of_bodies) > std::abs(load))
      throw ToolSlides(name(direction) + " slides on the bodies in the whole step, although " +
                         "friction could hold it: they move it too far in one step",
                       step);
    // Statics cannot cross a gap: on the way nothing balances the load.
    const bool in_the_air = std::abs(of_bodies) <= 1e-3 * std::abs(load);
    throw NothingResists(
      "nothing resists the motion of " + name(direction) + " against its load" +
      (in_the_air
         ? ", where it is now: if it is to close a gap first, place it without one, prescribe "
           "the motion until it touches, or take inertia ('Time integration/Scheme')"
         : ""));
  }



  std::string
  RigidTools::name(const Numbers &direction) const
  {
    std::size_t main = 0;
    for (std::size_t k = 0; k < direction.size(); ++k)
      if (std::abs(direction[k]) > std::abs(direction[main]))
        main = k;
    const Unknown &unknown = unknowns[main];
    return "the obstacle '" + tools[unknown.tool].name() + "' along '" +
           FreeMotionParameters::word(unknown.component) + "', one of its 'Free directions',";
  }
} // namespace Touchstone
