//! The refined solver's bridge. All vectors are in the world; quaternions are `[w, x, y, z]`, body to
//! world; angular momenta are per unit of the body's own mass, m²/s. SI units.

#[cxx::bridge(namespace = "smash")]
pub(crate) mod ffi {
    /// An annotated pose and one σ of each of its coordinates.
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct RefinedPose {
        time_s: f64,
        position: [f64; 3],
        position_std_m: f64,
        /// Only read where `has_orientation`.
        orientation: [f64; 4],
        orientation_std_rad: f64,
        has_orientation: bool,
        /// Its σ over that of the scene's noise. Only Rust reads it, where it states the deviations.
        noise_scale: f64,
    }

    /// A body that moves.
    #[derive(Debug, Clone, PartialEq)]
    struct RefinedBody {
        /// Principal moments of unit mass, m².
        inertia_per_mass: [f64; 3],
        /// In order of time.
        poses: Vec<RefinedPose>,
        /// Without, its orientation and spin are no unknowns.
        has_spin: bool,
        /// Full edges in m; of a sphere its diameter thrice.
        size: [f64; 3],
    }

    /// One operation of a law; its number is that of `effect::Operation`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct LawInstruction {
        operation: u8,
        target: u16,
        left: u16,
        right: u16,
        value: f64,
    }

    /// A law of an effect on one body.
    #[derive(Debug, Clone, PartialEq)]
    struct ActingLaw {
        body: usize,
        /// Laws with the same number belong to one effect.
        effect: usize,
        /// The number of an `effect::Hook`.
        hook: u8,
        /// −1 on the second body of an effect that acts between both.
        sign: f64,
        /// Where its parameters start in `RefinedUnknowns::parameters`, and how many scalars.
        first_parameter: usize,
        parameter_count: usize,
        registers: u16,
        result: u16,
        instructions: Vec<LawInstruction>,
    }

    /// What a parameter may be.
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct ParameterRule {
        low: f64,
        high: f64,
        /// At its start value.
        held: bool,
    }

    /// What is known: one or two bodies, and maybe a plane.
    #[derive(Debug, Clone, PartialEq)]
    struct RefinedScene {
        gravity_m_s2: f64,
        /// Unit vector along gravity.
        down: [f64; 3],
        /// Two unit vectors across `down`, about which the tilt is counted.
        across: [[f64; 3]; 2],
        /// One σ of each component of the tilt.
        tilt_std_rad: f64,
        bodies: Vec<RefinedBody>,
        /// Unit normal of the plane normal · x = height under a single body; zero without one.
        plane_normal: [f64; 3],
        /// The camera's centre; zero without one.
        camera: [f64; 3],
        /// The laws of all effects.
        laws: Vec<ActingLaw>,
        /// Of the laws' parameters, scalar by scalar.
        parameters: Vec<ParameterRule>,
    }

    /// A body at the collision.
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct RefinedMotion {
        position: [f64; 3],
        velocity_before: [f64; 3],
        spin_before: [f64; 3],
        orientation: [f64; 4],
    }

    /// All unknowns.
    #[derive(Debug, Clone, PartialEq)]
    struct RefinedUnknowns {
        bodies: Vec<RefinedMotion>,
        collision_time_s: f64,
        tilt: [f64; 2],
        /// On the reference body, per unit of its mass; along the plane's normal where there is one.
        impulse: [f64; 3],
        /// Only its two coordinates along `contact_basis` are unknown.
        contact_point: [f64; 3],
        contact_basis: [[f64; 3]; 2],
        /// ln(m_b / m_a).
        log_mass_ratio: f64,
        /// Of the effects, scalar by scalar.
        parameters: Vec<f64>,
    }

    /// Which unknowns are held at their start value.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    struct RefinedHold {
        collision_time: bool,
        log_mass_ratio: bool,
    }

    /// A restitution to be kept to, with a weight 1/σ; a weight of zero is none.
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct RestitutionPin {
        value: f64,
        weight: f64,
    }

    /// What the optimiser is given.
    #[derive(Debug, Clone)]
    struct RefinedProblem {
        start: RefinedUnknowns,
        /// The segment that the collision time stays in, s.
        earliest_s: f64,
        latest_s: f64,
        hold: RefinedHold,
        restitution: RestitutionPin,
        /// 0: only evaluates the start.
        most_iterations: u32,
        /// What the solution's Jacobian is to be by.
        jacobian: JacobianBy,
    }

    /// The unknowns that a Jacobian is by; its other columns are zero.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    enum JacobianBy {
        Nothing,
        Everything,
        /// The effects' parameters.
        Parameters,
    }

    /// Model minus observation, as a pose's residual.
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct RefinedResidual {
        position_m: [f64; 3],
        /// The rotation vector of q_obs⁻¹ q, in the body's frame; zero where it isn't annotated.
        turn_rad: [f64; 3],
    }

    /// A body just after the collision, per unit of its own mass.
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct RefinedLaunch {
        velocity_after: [f64; 3],
        spin_after: [f64; 3],
        /// After what the contact alone does: without a third party's impulse.
        contact_velocity_after: [f64; 3],
        contact_spin_after: [f64; 3],
        /// Principal moments of unit mass, with the effects' factors, m².
        inertia_per_mass: [f64; 3],
    }

    /// A body at one time.
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct FlownState {
        /// Centre of mass and true orientation.
        position: [f64; 3],
        velocity: [f64; 3],
        orientation: [f64; 4],
        spin: [f64; 3],
        /// What is annotated: the centre, the orientation.
        seen_position: [f64; 3],
        seen_orientation: [f64; 4],
    }

    /// The optimum. Information matrices (JᵀJ, of one channel each) are square, row by row, over:
    /// each body's position, velocity and, if it has a spin, l and a turn of its orientation in the
    /// world; collision time; tilt (with gravity); impulse (3, or 1 along the plane's normal);
    /// contact point along its basis (if a body has a spin); ln m (with two bodies); the parameters
    /// that aren't held.
    #[derive(Debug, Clone)]
    struct RefinedSolution {
        unknowns: RefinedUnknowns,
        /// ½ χ² with the tilt's prior, without that of the contact point and without pins.
        cost: f64,
        cost_initial: f64,
        iterations: u32,
        converged: bool,
        size: usize,
        position_information: Vec<f64>,
        orientation_information: Vec<f64>,
        prior_information: Vec<f64>,
        /// Body after body, in order of time.
        residuals: Vec<RefinedResidual>,
        /// Of the residuals over their deviations, row by row in their order, three of a position
        /// and three of an orientation that counts; empty unless asked for.
        jacobian: Vec<f64>,
    }

    /// The orientations of one flight.
    #[derive(Debug, Clone)]
    struct SpinFlight {
        inertia_per_mass: [f64; 3],
        collision_time_s: f64,
        /// Outwards from the collision; those without orientation are passed over.
        poses: Vec<RefinedPose>,
        /// l to start from.
        spin: [f64; 3],
        /// The ½ χ² beyond which nobody wants to know this fit.
        hopeless_cost: f64,
    }

    /// A flight's rotation by its own poses alone, at the collision.
    #[derive(Debug, Clone)]
    struct SpinFit {
        orientation: [f64; 4],
        spin: [f64; 3],
        /// ½ χ².
        cost: f64,
        /// JᵀJ over a turn of the orientation in the world and l, 6 × 6.
        information: [f64; 36],
    }

    /// How a body's flights differ at the collision, per unit of its own mass.
    #[derive(Debug, Clone)]
    struct Jump {
        position: [f64; 3],
        velocity: [f64; 3],
        /// W of the residual W (model − jump), 3 × 3 row by row.
        velocity_weight: [f64; 9],
        spin: [f64; 3],
        /// Zero where the spin isn't measured.
        spin_weight: [f64; 9],
    }

    /// The impulse that explains the jumps.
    #[derive(Debug, Clone)]
    struct JumpFit {
        impulse: [f64; 3],
        contact_point: [f64; 3],
        log_mass_ratio: f64,
        /// ½ χ² of the jumps.
        cost: f64,
    }

    unsafe extern "C++" {
        include!("refined_bridge.h");

        /// Minimises ½ χ² from the start.
        fn solve_refined(scene: &RefinedScene, problem: &RefinedProblem)
        -> Result<RefinedSolution>;

        /// The bodies just after the collision that `unknowns` stand for.
        fn launch(scene: &RefinedScene, unknowns: &RefinedUnknowns) -> Result<Vec<RefinedLaunch>>;

        /// The model's times of all poses, body after body: their stamps, or what effects make of
        /// them.
        fn pose_times(scene: &RefinedScene, unknowns: &RefinedUnknowns) -> Result<Vec<f64>>;

        /// Where `body` is, and is seen, at poses stamped `stamps_s`.
        fn fly(
            scene: &RefinedScene,
            unknowns: &RefinedUnknowns,
            body: usize,
            stamps_s: &[f64],
        ) -> Result<Vec<FlownState>>;

        /// Fits one flight's rotation to its own poses.
        fn fit_spin(flight: &SpinFlight) -> Result<SpinFit>;

        /// Fits the impulse, the contact point and the mass ratio to the jumps of the bodies,
        /// starting from `start`.
        fn fit_jump(
            scene: &RefinedScene,
            jumps: &[Jump],
            start: &RefinedUnknowns,
        ) -> Result<JumpFit>;
    }
}
