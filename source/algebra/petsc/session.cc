// SPDX-License-Identifier: LGPL-2.1-or-later

#include <deal.II/base/config.h>

#ifdef DEAL_II_WITH_PETSC

#  include <touchstone/algebra/petsc/session.h>

#  include <string>
#  include <utility>
#  include <vector>

#  ifndef PETSC_USE_COMPLEX

namespace Touchstone
{
  namespace Petsc
  {
    OptionsDatabase::OptionsDatabase(const std::string &text)
    {
      Session session(nullptr);
      session.check(PetscOptionsCreate(&data));
      session.check(PetscOptionsInsertString(data, text.c_str()));
      // BoomerAMG (hypre) takes interpolation vectors, here the rigid motions, into account only
      // with a nodal coarsening and a variant of vector interpolation: the defaults below.
      const auto text_of = [&](const char *name) {
        char      value[64] = "";
        PetscBool given     = PETSC_FALSE;
        session.check(PetscOptionsGetString(data, nullptr, name, value, sizeof(value), &given));
        return std::string(value);
      };
      const std::string hypre_type = text_of("-pc_hypre_type");
      if (text_of("-pc_type") == "hypre" && (hypre_type.empty() || hypre_type == "boomeramg"))
        for (const auto &[name, value] :
             {std::make_pair("-pc_hypre_boomeramg_nodal_coarsen", "6"),
              std::make_pair("-pc_hypre_boomeramg_vec_interp_variant", "2")})
          if (text_of(name).empty())
            session.check(PetscOptionsSetValue(data, name, value));
    }



    std::vector<std::string>
    OptionsDatabase::unused() const
    {
      PetscInt                 n = 0;
      char                   **names, **values;
      std::vector<std::string> result;
      if (PetscOptionsLeftGet(data, &n, &names, &values) != 0)
        return result;
      for (PetscInt k = 0; k < n; ++k)
        result.push_back("-" + std::string(names[k]));
      PetscOptionsLeftRestore(data, &n, &names, &values);
      return result;
    }
  } // namespace Petsc
} // namespace Touchstone

#  endif
#endif
