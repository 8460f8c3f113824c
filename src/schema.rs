//! JSON Schemas of the files, made from the types that read and write them.

use schemars::generate::SchemaSettings;

use crate::compare::Comparison;
use crate::diagnose::Diagnosis;
use crate::effect::file::EffectFile;
use crate::improve::Improvement;
use crate::json::pretty;
use crate::power::Power;
use crate::reconstruct::Reconstruction;
use crate::report::Report;
use crate::scene::SceneFile;
use crate::simulate::{SimulationSpec, Truth};
use crate::studio::{Action, LawCheck, SessionFile, StudioState};

/// The files that have a schema.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
#[non_exhaustive]
pub enum SchemaKind {
    /// What was observed: `smash.scene/1`
    Scene,
    /// How the bodies collided: `smash.result/1`
    Result,
    /// Results against the poses and each other: `smash.comparison/1`
    Comparison,
    /// Which effect the model lacks: `smash.diagnosis/1`
    Diagnosis,
    /// A ladder of effects: `smash.improvement/1`
    Improvement,
    /// What the page of a report shows: `smash.report/1`
    Report,
    /// What was tried in a studio: `smash.session/1`
    Session,
    /// What the page of a studio shows: `smash.studio/1`
    Studio,
    /// What a planned film could show: `smash.power/1`
    Power,
    /// A law that the base model lacks (TOML)
    Effect,
    /// What to simulate: `smash.simulation/1`
    Simulation,
    /// What a simulated scene was made with: `smash.truth/1`
    Truth,
}

/// The JSON Schema (draft 2020-12) of files of this kind, as text.
///
/// What it can't express (sums over several fields, unit lengths, times in order) is checked when
/// a file is read.
pub fn schema(kind: SchemaKind) -> String {
    let mut generator = SchemaSettings::draft2020_12().into_generator();
    pretty(&match kind {
        SchemaKind::Scene => generator.into_root_schema_for::<SceneFile>(),
        SchemaKind::Result => generator.into_root_schema_for::<Reconstruction>(),
        SchemaKind::Comparison => generator.into_root_schema_for::<Comparison>(),
        SchemaKind::Diagnosis => generator.into_root_schema_for::<Diagnosis>(),
        SchemaKind::Improvement => generator.into_root_schema_for::<Improvement>(),
        SchemaKind::Report => generator.into_root_schema_for::<Report>(),
        SchemaKind::Session => generator.into_root_schema_for::<SessionFile>(),
        SchemaKind::Studio => {
            // What the page sends, and is answered beside the state.
            generator.subschema_for::<Action>();
            generator.subschema_for::<LawCheck>();
            generator.into_root_schema_for::<StudioState>()
        }
        SchemaKind::Power => generator.into_root_schema_for::<Power>(),
        SchemaKind::Effect => generator.into_root_schema_for::<EffectFile>(),
        SchemaKind::Simulation => generator.into_root_schema_for::<SimulationSpec>(),
        SchemaKind::Truth => generator.into_root_schema_for::<Truth>(),
    })
}
