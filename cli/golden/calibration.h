#pragma once

namespace hybridrt::cli {

/// The seconds that a fixed small picture takes this machine: what budgets of time are multiples of, so that they hold
/// on fast machines and slow ones. The median of five.
double calibration_seconds();

}  // namespace hybridrt::cli
