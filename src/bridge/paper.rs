//! The bridge to C++: data in, data out, every function a `Result`; no Ceres type crosses it.
//!
//! All vectors are in the *gravity frame* of [`crate::reconstruct`]: the scene turned so that y
//! points along gravity. Quaternions are `[w, x, y, z]`, body to gravity frame. SI units, except
//! that the parabolas' time counts frames, as in the paper.

#[cxx::bridge(namespace = "smash")]
pub(crate) mod ffi {
    /// An annotated pose.
    #[derive(Debug, Clone)]
    struct PaperObservation {
        time_frames: f64,
        position: [f64; 3],
        /// Only read where `has_orientation`.
        orientation: [f64; 4],
        has_orientation: bool,
    }

    /// A body that moves.
    #[derive(Debug, Clone)]
    struct PaperBody {
        /// Principal moments of unit mass, m².
        inertia_per_mass: [f64; 3],
        observations: Vec<PaperObservation>,
        /// Without, its orientation and angular momentum are no unknowns, and eq. 12 and its
        /// eq. 14 are left out.
        has_spin: bool,
    }

    /// What is known: one or two bodies, and maybe a plane.
    #[derive(Debug, Clone)]
    struct PaperScene {
        frames_per_second: f64,
        gravity_m_s2: f64,
        bodies: Vec<PaperBody>,
        /// Unit normal of the plane normal · x = height under a single body; zero without one.
        plane_normal: [f64; 3],
        plane_height_m: f64,
    }

    /// The unknowns of one of the four flights (SMASH eq. 5 and 8).
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct PaperFlight {
        /// b2 in m/frame (along gravity), b3 in m/frame (horizontal), β_y0 in rad.
        parabola: [f64; 3],
        /// k in kg·m²/s with the reference body's mass 1.
        angular_momentum: [f64; 3],
    }

    /// The unknowns of one body.
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct PaperBodyUnknowns {
        /// b4: the position at the collision, m.
        position: [f64; 3],
        /// q^c: the orientation at the collision.
        orientation: [f64; 4],
        before: PaperFlight,
        after: PaperFlight,
    }

    /// All unknowns: 47 for two bodies.
    #[derive(Debug, Clone, PartialEq)]
    struct PaperUnknowns {
        bodies: Vec<PaperBodyUnknowns>,
        /// β_x and β_y1 in rad, shared by all parabolas.
        tilt: [f64; 2],
        /// x_c, m.
        contact_point: [f64; 3],
        /// J = jn in kg·m/s, on the reference body.
        impulse: [f64; 3],
        /// m_b / m_a.
        mass_ratio: f64,
    }

    /// The three phases of SMASH section 4.1.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    enum PaperPhase {
        /// Trajectories and conservation of momentum.
        Trajectories,
        /// And the impulse, at a contact point that is tied to the centres.
        Impulse,
        /// And the contact point.
        ContactPoint,
    }

    /// What a phase ended with. Costs are eq. 16.
    #[derive(Debug, Clone, PartialEq)]
    struct PaperSolution {
        unknowns: PaperUnknowns,
        cost_initial: f64,
        cost_final: f64,
        iterations: u32,
        /// Whether a tolerance, not the limit on iterations, ended it.
        converged: bool,
    }

    /// A pose of the model.
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct PaperPose {
        position: [f64; 3],
        orientation: [f64; 4],
    }

    /// Velocities of a body at the collision, m/s.
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct PaperVelocities {
        before: [f64; 3],
        after: [f64; 3],
    }

    unsafe extern "C++" {
        include!("bridge.h");

        /// Runs one phase from `start`, with the collision at `collision_frames`.
        fn solve_paper_phase(
            scene: &PaperScene,
            collision_frames: f64,
            phase: PaperPhase,
            start: &PaperUnknowns,
        ) -> Result<PaperSolution>;

        /// The model's pose of body number `body` at each of `times_frames`.
        fn predict_paper_poses(
            scene: &PaperScene,
            collision_frames: f64,
            unknowns: &PaperUnknowns,
            body: usize,
            times_frames: &[f64],
        ) -> Result<Vec<PaperPose>>;

        /// The velocities of body number `body` at the collision (eq. 7).
        fn paper_collision_velocities(
            scene: &PaperScene,
            unknowns: &PaperUnknowns,
            body: usize,
        ) -> Result<PaperVelocities>;

        /// The version of Ceres that this was built with.
        fn ceres_version() -> Result<String>;

        /// Keeps Ceres' own log off standard error; for the whole process.
        fn silence_ceres_log() -> Result<()>;
    }
}
