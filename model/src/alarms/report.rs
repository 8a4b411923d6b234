//! All alarms as a table and as JSON.

use super::run::{Finding, LayerReport, run_alarm, run_sound, run_sound_replica};
use super::{all, of_replicas};
use serde::Serialize;
use std::fmt;

/// One alarm, through the layers.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct AlarmReport {
    /// Its name.
    pub name: &'static str,
    /// What is broken.
    pub broken: &'static str,
    /// The clause that it offends at its root.
    pub offends: &'static str,
    /// Whether any layer found it.
    pub found: bool,
    /// The first layer that did.
    pub layer: Option<&'static str>,
    /// At which bound.
    pub bound: Option<String>,
    /// The clause that broke there.
    pub clause: Option<String>,
    /// Steps of the counterexample.
    pub steps: Option<usize>,
    /// Seconds, of all layers tried.
    pub seconds: f64,
    /// Each layer that was tried.
    pub layers: Vec<LayerReport>,
}

/// All alarms, and the sound core.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Report {
    /// Each alarm.
    pub alarms: Vec<AlarmReport>,
    /// The sound core in the same layers and bounds: nothing may be found.
    pub sound: Vec<LayerReport>,
    /// The sound replica beside it.
    pub sound_replica: Vec<LayerReport>,
}

impl Report {
    /// Whether every flaw was found, and nothing where there is none.
    pub fn is_good(&self) -> bool {
        let mut sound = self.sound.iter().chain(&self.sound_replica);
        self.alarms.iter().all(|alarm| alarm.found) && sound.all(|layer| layer.finding.is_none())
    }
}

/// Runs every alarm, and the sound core. With `all_layers`, every layer is tried on every alarm.
/// `[spec: CHECK-8]`
pub fn report(all_layers: bool) -> Report {
    let cores = all().into_iter().map(|alarm| {
        let layers = run_alarm(&alarm, all_layers);
        alarm_report(alarm.name, alarm.broken, alarm.clause, layers)
    });
    let replicas = of_replicas().into_iter().map(|alarm| {
        let layers = alarm.run(all_layers);
        alarm_report(alarm.name, alarm.broken, alarm.clause, layers)
    });
    let alarms = cores.chain(replicas).collect();
    Report { alarms, sound: run_sound(), sound_replica: run_sound_replica() }
}

fn alarm_report(
    name: &'static str,
    broken: &'static str,
    offends: &'static str,
    layers: Vec<LayerReport>,
) -> AlarmReport {
    let first: Option<Finding> = layers.iter().find_map(|layer| layer.finding.clone());
    AlarmReport {
        name,
        broken,
        offends,
        found: first.is_some(),
        layer: first.as_ref().map(|finding| finding.layer),
        bound: first.as_ref().map(|finding| finding.bound.clone()),
        clause: first.as_ref().map(|finding| finding.clause.clone()),
        steps: first.as_ref().map(|finding| finding.steps),
        seconds: layers.iter().map(|layer| layer.seconds).sum(),
        layers,
    }
}

/// A line for each alarm: the clause and bound in each layer that found it.
impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for alarm in &self.alarms {
            let verdict = if alarm.found { "found" } else { "MISSED" };
            writeln!(f, "{verdict:<7} {:<24} {}", alarm.name, alarm.broken)?;
            for layer in &alarm.layers {
                write_layer(f, layer)?;
            }
        }
        write_sound(f, "sound core", &self.sound)?;
        write_sound(f, "sound replica", &self.sound_replica)
    }
}

fn write_sound(f: &mut fmt::Formatter<'_>, name: &str, layers: &[LayerReport]) -> fmt::Result {
    let is_silent = layers.iter().all(|layer| layer.finding.is_none());
    writeln!(f, "{:<7} {name:<24} nothing is broken", if is_silent { "silent" } else { "FALSE" })?;
    layers.iter().try_for_each(|layer| write_layer(f, layer))
}

fn write_layer(f: &mut fmt::Formatter<'_>, layer: &LayerReport) -> fmt::Result {
    if let Some(found) = &layer.finding {
        return writeln!(
            f,
            "        {} {:<10} {} steps, {}",
            layer.layer, found.clause, found.steps, found.bound
        );
    }
    let end = if layer.exhaustive { "" } else { ", not all to their ends" };
    writeln!(f, "        {} not up to {}{end}", layer.layer, layer.searched)
}
