//! Predicted times of a frame on eight classes of GPUs: the frame's counted operations and bytes, divided by the rates
//! that GPUs of the class are assumed to reach.

use super::cost::Cost;
use std::fmt;

/// A class of GPUs, with the rates at which its members are assumed to run the program's shaders.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GpuClass {
    /// Name of a common GPU of the class.
    pub name: &'static str,
    /// Assumed rate of operations, 10^9/s: a fifth to a third of the peak rate, as shaders with many texture reads,
    /// special functions and registers reach.
    pub giga_ops_per_s: f64,
    /// Peak rate of its memory, GB/s.
    pub memory_gb_s: f64,
    /// Width and height of the pictures that are usually drawn with it, pixels.
    pub picture_px: [u32; 2],
}

const fn class(name: &'static str, giga_ops_per_s: f64, memory_gb_s: f64, picture_px: [u32; 2]) -> GpuClass {
    GpuClass { name, giga_ops_per_s, memory_gb_s, picture_px }
}

/// Size of a page on a phone whose pixels the page counts as 2 x 2, pixels.
const PHONE: [u32; 2] = [824, 1560];
const FULL_HD: [u32; 2] = [1920, 1080];

/// The eight classes for which `seastate bench` prints a budget, slowest first.
pub const GPU_CLASSES: [GpuClass; 8] = [
    class("UHD 620", 120.0, 34.0, FULL_HD),
    class("Mali-G78", 250.0, 51.0, PHONE),
    class("Adreno 660", 340.0, 51.0, PHONE),
    // Measured (docs/performance.md): 4 of its 132 multiprocessors draw pixels.
    class("H200", 510.0, 845.0, [3840, 2160]),
    class("Iris Xe", 600.0, 68.0, FULL_HD),
    class("M1", 900.0, 68.0, [2560, 1600]),
    class("GTX 1060", 1400.0, 192.0, FULL_HD),
    class("RTX 4070", 7000.0, 504.0, [2560, 1440]),
];

impl GpuClass {
    /// Predicted time of work on a GPU of this class, ms: that of its arithmetic or of its memory traffic, whichever is
    /// longer. It is right within a factor of about two.
    pub fn predicted_ms(&self, work: &Cost) -> f64 {
        1e-6 * (work.flops / self.giga_ops_per_s).max(work.bytes / self.memory_gb_s)
    }
}

/// Prints what predicted times assume.
pub struct Assumptions;

impl fmt::Display for Assumptions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rate = |gpu: &GpuClass| format!("{} {} and {}", gpu.name, gpu.giga_ops_per_s, gpu.memory_gb_s);
        writeln!(
            f,
            "predictions are counted work divided by assumed rates, right within a factor of two; shaders count with \
             what they execute on average in the default picture. Rates in Gop/s and GB/s: {}",
            GPU_CLASSES.iter().map(rate).collect::<Vec<_>>().join(", ")
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slower_of_arithmetic_and_memory_decides() {
        let gpu = class("test", 100.0, 10.0, FULL_HD);
        assert_eq!(gpu.predicted_ms(&Cost { flops: 2e9, bytes: 1e6, reads: 0.0 }), 20.0);
        assert_eq!(gpu.predicted_ms(&Cost { flops: 2e6, bytes: 1e9, reads: 0.0 }), 100.0);
    }

    #[test]
    fn classes_are_sorted_by_rate() {
        assert!(GPU_CLASSES.is_sorted_by(|a, b| a.giga_ops_per_s <= b.giga_ops_per_s));
    }
}
