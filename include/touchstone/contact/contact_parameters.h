#ifndef touchstone_contact_contact_parameters_h
#define touchstone_contact_contact_parameters_h

#include <touchstone/base/choice.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <vector>

namespace Touchstone
{
  class Enforcement;
  class FrictionLaw;
  class Pairing;
  struct ContactParameters;
  struct PairingInput;

  /** @brief Section "Contact pair NAME". */
  struct ContactPairParameters
  {
    std::string              name;
    std::string              slave_body;
    std::vector<std::string> slave_boundaries;
    /** Master body and its boundaries, or the name of an obstacle. */
    std::string              master_body;
    std::vector<std::string> master_boundaries;
    std::string              obstacle;
    /** How rows are made; keys of its own stand beside the key. */
    Choice<Registry<Pairing, const PairingInput &>> pairing{"averaged"};
    /** "frictionless", "tied", or the name of a friction law. */
    Choice<Registry<FrictionLaw>> behaviour{"frictionless"};
    /** The friction law with its own parameters read, subsection "Friction"; null
     * without friction. */
    std::shared_ptr<FrictionLaw> friction;
    /** What becomes of an overlap of the bodies as they are placed: an
     * "interference" that presses them apart, "adjust": no overlap, "ramp": an
     * interference that grows over the time of the run. */
    std::string initial_overlap = "interference";
    /** "finite" (search in each iteration) or "small" (reference pairing);
     * tied pairs are always "small". */
    std::string sliding = "finite";
    /** "manifold": gaps and normals from the exact surfaces where the geometry
     * knows them; "faceted": from the faces of the mesh. */
    std::string contact_geometry = "manifold";
    /** "face", "averaged" (over the faces around a node) or "smoothed" (gap and
     * normal of a smooth patch over each face). */
    std::string master_normal = "averaged";
    /** Farthest distance at which a slave node looks for a master face,
     * length; 0 chooses it from the size of the faces. */
    double search_distance = 0.;
    /** How far beyond the edge of the master surface a slave node is still
     * held, as a fraction of the face. */
    double edge_tolerance = 0.01;

    /** @brief "Contact pair NAME". */
    std::string
    section() const;

    /** @brief Whether the bodies are joined where they face each other. */
    bool
    tied() const
    {
      return behaviour.name == "tied";
    }

    /** @param values Of this section: pairing and behaviour decide on other keys. */
    void
    declare(dealii::ParameterHandler &prm, const EarlyValues &values);
    void
    check(const std::string &section) const;
  };

  /** @brief Section "Contact": how all pairs of the scene are enforced. */
  struct ContactParameters
  {
    /** "elimination", "lagrange multipliers", ...; keys of its own stand beside the key. */
    Choice<Registry<Enforcement, const ContactParameters &>> enforcement{"elimination"};
    /** Multiplies the automatic penalty (Young's modulus times tributary area over
     * face size, times 100 for penalty and 20 for augmented Lagrange); no unit. */
    double penalty_factor = 1.;
    /** Augmented Lagrange: "merged" with Newton's iterations, or in an "outer"
     * loop around them (Uzawa). */
    std::string augmentation = "merged";
    /** Stick: "exact" without any slip, or "regularised" by elastic slip. */
    std::string friction = "exact";
    /** Multiplies the automatic stiffness of regularised stick; no unit. */
    double tangential_factor = 1.;
    /** "consistent": with the change of normals, stencils and slip directions;
     * "frozen": without; "automatic": consistent with friction, if the linear
     * solver allows it. */
    std::string linearisation = "automatic";

    /** @param values Of this section: the enforcement decides on other keys. */
    void
    declare(dealii::ParameterHandler &prm, const EarlyValues &values);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif
