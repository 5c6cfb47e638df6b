//! Puts the stream's frames together to whole states, and shows each to the checks.

use flat_rig::check::{Checks, Finding, Series};
use flat_wire::message::{BodyState, ContactState, Detail, Frame, StreamRequest};

use crate::collect::Collector;
use crate::drive;
use crate::job::Job;

/// Watches a run for its checks.
#[derive(Debug)]
pub struct Observer {
    checks: Checks,
    steps: u32,
    of_bodies: Collector<BodyState>,
    of_contacts: Collector<ContactState>,
    /// A step with its bodies; its contacts may still follow.
    latest: Option<(u32, Vec<BodyState>)>,
    contacts: Vec<ContactState>,
    seen: u32,
}

impl Observer {
    /// Watches a job for what its scene promises.
    pub fn new(job: &Job) -> Self {
        Self {
            checks: Checks::new(job.scene, &job.parameters, job.request.scalar, job.player()),
            steps: job.steps,
            of_bodies: Collector::new(),
            of_contacts: Collector::new(),
            latest: None,
            contacts: Vec::new(),
            seen: 0,
        }
    }

    /// The same, and keeps a series of every step.
    pub fn recording(job: &Job) -> Self {
        let mut observer = Self::new(job);
        observer.checks.record();
        observer
    }

    /// What was recorded.
    pub fn series(&self) -> Series {
        self.checks.series()
    }

    /// What must be streamed.
    pub fn stream(&self) -> StreamRequest {
        let contacts = self.checks.want_contacts;
        StreamRequest { detail: Detail::Full, every: 1, contacts, ..drive::digests(self.steps) }
    }

    /// Takes the run's next frame.
    pub fn take(&mut self, frame: &Frame) {
        match frame {
            Frame::Bodies { at, total, bodies } => {
                if let Some(state) = self.of_bodies.push(*at, *total, bodies) {
                    self.latest = Some((at.step, state));
                }
            }
            Frame::Contacts { at, total, contacts } => {
                if let Some(all) = self.of_contacts.push(*at, *total, contacts) {
                    self.contacts = all;
                }
            }
            // A step without contacts sends no frame of them: only what comes next tells.
            Frame::Step { .. } | Frame::Finished { .. } => self.show(),
            _ => {}
        }
    }

    fn show(&mut self) {
        if let Some((step, bodies)) = self.latest.take() {
            self.seen += 1;
            self.checks.observe(step, &bodies, &self.contacts);
        }
        self.contacts.clear();
    }

    /// What came of every check; the first says whether every step was seen.
    pub fn findings(&self) -> Vec<Finding> {
        let mut findings = vec![Finding::count("full state of every step", self.steps, self.seen, "")];
        findings.extend(self.checks.findings());
        findings
    }
}
