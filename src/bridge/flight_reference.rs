//! The bridge that only tests use: derivatives made in one way beside those made in another.

#[cxx::bridge(namespace = "smash")]
pub(crate) mod ffi {
    /// How far the flights of a problem are from their reference.
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct FlightDifference {
        flights: u32,
        /// The largest difference of a residual, in its deviations.
        value: f64,
        /// The largest difference of a derivative, over the largest in its column.
        derivative: f64,
    }

    unsafe extern "C++" {
        include!("flight_reference.h");

        type RefinedScene = crate::bridge::refined::ffi::RefinedScene;
        type RefinedProblem = crate::bridge::refined::ffi::RefinedProblem;

        /// Compares all flights at the start of `problem`.
        fn compare_flights(
            scene: &RefinedScene,
            problem: &RefinedProblem,
        ) -> Result<FlightDifference>;

        /// The automatic derivatives of all flights with effects, beside central differences.
        fn difference_effects(
            scene: &RefinedScene,
            problem: &RefinedProblem,
        ) -> Result<FlightDifference>;
    }
}
