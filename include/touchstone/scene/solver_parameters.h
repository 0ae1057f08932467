#ifndef touchstone_scene_solver_parameters_h
#define touchstone_scene_solver_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief Section "Discretisation". */
  struct DiscretisationParameters
  {
    /** Polynomial degree of FE_Q, 1 or 2, for all bodies. */
    unsigned int degree = 1;
    /** Multiplies the number of cells per direction of built-in geometries;
     * whole powers of two refine the mesh with its manifolds. Meshes from
     * files accept powers of two only. */
    double refinement_factor = 1.;
    /** "automatic", "coordinates", "p4est", "METIS" or "METIS, cells only". */
    std::string partitioner = "automatic";
    /** For p4est, contact work of a slave face over the work of a cell; no unit. */
    double contact_weight = 0.;

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };

  /** @brief Section "Refinement": a mesh that follows the solution. */
  struct RefinementParameters
  {
    /** "none", "region", "Kelly" or "recovered stress". */
    std::string estimator = "none";
    /** Of solving and refining in the first step, and in each later one. */
    unsigned int cycles = 3, cycles_per_step = 1;
    /** Share of the estimated squared error in the cells that are refined, and in
     * those that may be coarsened. */
    double refine_fraction = 0.3, coarsen_fraction = 0.02;
    /** Share of the squared variation of the contact pressure in the slave faces
     * that are refined. */
    double contact_fraction = 0.7;
    /** Times that a cell is halved at most. */
    unsigned int maximum_level = 4;
    unsigned int maximum_cells = 1000000;
    /** Relative estimated error at which refinement ends; no unit. */
    double tolerance = 0.;
    /** Formula of x, y, z, t; refined where it is positive. */
    std::string region;

    bool
    active() const
    {
      return estimator != "none";
    }

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };

  /** @brief Section "Load stepping". */
  struct LoadSteppingParameters
  {
    double end_time = 1.;
    /** Number of steps when none is cut. */
    unsigned int steps = 1;
    /** A step that does not converge is halved at most this many times. */
    unsigned int maximum_cuts = 8;

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };

  /** @brief Section "Newton": the semismooth Newton method of a step. */
  struct NewtonParameters
  {
    /** Out-of-balance force relative to the forces that act; no unit. */
    double residual_tolerance = 1e-10;
    /** Gap or penetration relative to the size of the slave faces; no unit. */
    double       gap_tolerance      = 1e-8;
    unsigned int maximum_iterations = 40;
    /** Take back a part of increments that make things worse: "automatic" or
     * "none". */
    std::string line_search = "automatic";

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };

  /** @brief Section "Linear solver". */
  struct LinearSolverParameters
  {
    /** "automatic", "MUMPS", "Belos CG" or "Belos GMRES". */
    std::string type = "automatic";
    /** Relative residual to which an iterative solver takes the system of a
     * Newton iteration (inexact Newton); no unit. */
    double       tolerance          = 1e-4;
    unsigned int maximum_iterations = 2000;
    /** Iterations of GMRES after which it starts anew, to save memory. */
    unsigned int restart = 100;
    /** Of iterative solvers: "multigrid" or "diagonal". */
    std::string preconditioner = "multigrid";
    /** No key: an iterative solver fails at once if it would take more iterations than these;
     * 0: it goes on. */
    unsigned int patience = 0;
    /** Of iterative solvers: "applied" or "assembled". */
    std::string contact_operator = "applied";
    /** Of MUMPS: relative size of what is left out of the blocks of its factors; 0
     * keeps all; no unit. */
    double low_rank_tolerance = 0.;
    /** Of MUMPS: the factors are kept in files. */
    bool out_of_core = false;

    /** @brief Whether the type is one that only iterates. */
    bool
    iterative() const
    {
      return type == "Belos CG" || type == "Belos GMRES";
    }

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };

  /** @brief Section "Output". */
  struct OutputParameters
  {
    /** Folder; empty: output/STEM for a scene file STEM.prm. */
    std::string directory;
    /** Write solution and contact VTU files every so many steps; 0: never. */
    unsigned int vtu_interval = 1;

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };

  /** @brief Section "Checkpoints": from which a run that was stopped goes on. */
  struct CheckpointParameters
  {
    /** Write one every so many steps; 0: not by steps. */
    unsigned int steps_between = 0;
    /** Write one after a step if the last is as long ago, minutes; 0: not by time. */
    double minutes_between = 0.;

    bool
    active() const
    {
      return steps_between > 0 || minutes_between > 0.;
    }

    void
    declare(dealii::ParameterHandler &prm);
  };

  /**
   * @brief Section "Reference solution": the exact answer that the result is
   * held against; what it gives stands under `errors` in summary.json.
   */
  struct ReferenceParameters
  {
    /** Name under which the reference is registered ("none",
     * "interference fit", "hertz", "uniform stress", ...). */
    std::string type = "none";
    /** The contact pair that is compared; empty: the first. */
    std::string pair;
    /** Named numbers that the type asks for ("radius: 10, pressure: 5"). */
    std::string values;
    /** Expression in x, y, z, t: the contact pressure of the reference "formula". */
    std::string pressure;

    /** @brief The named numbers. @throws InputError in the name of @p section. */
    std::map<std::string, double>
    numbers(const std::string &section) const;

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif
