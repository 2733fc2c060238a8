#pragma once

namespace hybridrt::cli {

/// The share of all processors' time that other processes use, 0-1, watched for so long. 0 where the system does not
/// tell.
double share_of_others(double watch_ms);

/// Watches until others use less than `quiet`; returns their share. Gives up after `longest_s` seconds, or when a
/// signal asks to stop.
double wait_until_quiet(double quiet, double longest_s);

}  // namespace hybridrt::cli
