// FittedMaterials: the materials of a scene as functions of the unknowns of a fit.
#pragma once

#include <string>
#include <vector>

#include "solve/unknown.h"
#include "steradian/solve.h"

namespace steradian::solving {

class FittedMaterials {
 public:
  FittedMaterials() = default;
  // Appends its unknowns and problems. The scene must outlive this object.
  FittedMaterials(const Scene& scene, const std::vector<MaterialFit>& fits, std::vector<Unknown>& unknowns,
                  std::vector<std::string>& problems);

  bool empty() const { return fitted_.empty(); }
  std::size_t count() const { return fitted_.size(); }
  const std::string& name_of(std::size_t material) const { return fitted_[material].name; }
  // All materials of the scene at some values of the fit's unknowns; none if none is fitted.
  std::vector<SurfaceMaterial> at(const std::vector<double>& x) const;
  // The fitted ones.
  std::vector<MaterialChange> changes_at(const std::vector<double>& x) const;
  // Statements about materials that several meshes share.
  std::vector<std::string> notes() const;

 private:
  struct Fitted {
    std::string name;
    MaterialChange start;
    std::vector<std::size_t> unknowns;
    std::vector<UnknownKind> kinds;  // by unknown
  };

  const Scene* scene_ = nullptr;
  std::vector<Fitted> fitted_;
};

}  // namespace steradian::solving
