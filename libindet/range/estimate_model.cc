#include "libindet/range/estimate_model.h"

#include <algorithm>
#include <cmath>

namespace indet {

LogPrediction predict(const EstimateModel& model, bool tangential, const ContactSituation& contact) {
  const double limit = contact.mu * contact.normal;  // of the tangential force
  std::array<double, EstimateModel::kCovariates> c = {
      std::log(contact.width / contact.mean_width),
      std::log(contact.width / (tangential ? limit : contact.normal)),
      std::log(contact.width_T / (contact.mu * contact.width_R)),
      std::abs(contact.tangential) / limit,
  };
  for (std::size_t k = 0; k < c.size(); ++k) {
    // Without friction, or without force, there is no such ratio.
    c[k] = std::isnan(c[k]) ? model.least[k] : std::clamp(c[k], model.least[k], model.largest[k]);
  }
  const double D = std::log(std::log(std::max(EstimateModel::kLeastDimension, contact.dimension)));
  const std::array<double, EstimateModel::kLocationTerms> terms = {
      1, D, c[0], c[1], c[2], c[3], c[0] * c[0], c[1] * c[1], c[0] * D, c[1] * D};
  LogPrediction result{0, 0};
  for (std::size_t k = 0; k < terms.size(); ++k) result.location += model.location[k] * terms[k];
  for (std::size_t k = 0; k < model.scale.size(); ++k) result.scale += model.scale[k] * terms[k];
  result.scale = std::exp(result.scale);
  return result;
}

}  // namespace indet
