use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::Thread;
use std::time::{Duration, Instant};

use elbowroom::planning::{Monitor, Stage};
use pyo3::prelude::*;

use crate::threads::with_threads;
use crate::{errors, fault};

/// How long a Ctrl-C may go unnoticed.
const LOOK_EVERY: Duration = Duration::from_millis(20);

/// Farthest deadline kept (s): beyond it a clock would overflow, and nobody waits.
const LONGEST_TIMEOUT: f64 = 1e9;

/// The clock of a piece of work: when each stage began, and when to stop.
pub(crate) struct Watch {
    stopped: AtomicBool,
    deadline: Option<Instant>,
    stages: Mutex<Vec<(Stage, Instant)>>,
}

impl Monitor for Watch {
    fn stage(&self, stage: Stage) {
        if let Ok(mut stages) = self.stages.lock() {
            stages.push((stage, Instant::now()));
        }
    }

    fn keep_going(&self) -> bool {
        !self.stopped.load(Ordering::Relaxed)
            && self.deadline.is_none_or(|deadline| Instant::now() < deadline)
    }
}

impl Watch {
    fn stages(&self) -> Vec<(Stage, Instant)> {
        self.stages.lock().map(|stages| stages.clone()).unwrap_or_default()
    }
}

/// Wakes the waiting thread when the work ends, by a panic too.
struct Announce<'a> {
    done: &'a AtomicBool,
    waiting: &'a Thread,
}

impl Drop for Announce<'_> {
    fn drop(&mut self) {
        self.done.store(true, Ordering::Release);
        self.waiting.unpark();
    }
}

/// Seconds spent in each stage.
pub(crate) type Timings = Vec<(&'static str, f64)>;

/// The same, for what keeps them.
pub(crate) fn told(timings: Timings) -> Vec<(String, f64)> {
    timings.into_iter().map(|(stage, seconds)| (stage.to_owned(), seconds)).collect()
}

/// Does `work` on a thread of its own, so that this one can look out for Ctrl-C and tell `on_stage` the name of
/// each stage as it begins.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    timeout: Option<f64>,
    on_stage: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watch) -> T + Send,
) -> PyResult<(T, Timings)> {
    let begun = Instant::now();
    let watch = Watch {
        stopped: AtomicBool::new(false),
        deadline: errors::timeout(timeout)?
            .filter(|&seconds| seconds < LONGEST_TIMEOUT)
            .map(|seconds| begun + Duration::from_secs_f64(seconds)),
        stages: Mutex::new(Vec::new()),
    };
    let done = AtomicBool::new(false);
    let waiting = std::thread::current();
    let outcome = std::thread::scope(|scope| {
        let worker = scope.spawn(|| {
            let _announce = Announce { done: &done, waiting: &waiting };
            with_threads(|| {
                let result = work(&watch);
                (result, Instant::now())
            })
        });
        let mut told = 0;
        let mut look = || -> PyResult<()> {
            py.check_signals()?;
            if let Some(on_stage) = on_stage {
                for (stage, _) in watch.stages().into_iter().skip(told) {
                    on_stage.call1((stage.name(),))?;
                    told += 1;
                }
            }
            Ok(())
        };
        let mut looked = Ok(());
        while !done.load(Ordering::Acquire) {
            py.detach(|| std::thread::park_timeout(LOOK_EVERY));
            if looked.is_ok() {
                looked = look();
                if looked.is_err() {
                    watch.stopped.store(true, Ordering::Relaxed);
                }
            }
        }
        let outcome = py.detach(|| worker.join());
        looked.map(|()| outcome)
    })?;
    let outcome = outcome.map_err(|panic| errors::internal(py, &fault::in_words(&*panic)))?;
    let (result, end) = outcome.ok_or_else(|| errors::no_threads(py))?;
    Ok((result, timings(&watch.stages(), end)))
}

fn timings(stages: &[(Stage, Instant)], end: Instant) -> Timings {
    let ends = stages.iter().skip(1).map(|&(_, begun)| begun).chain([end]);
    let spent =
        stages.iter().zip(ends).map(|(&(stage, begun), end)| (stage.name(), (end - begun).as_secs_f64()));
    let mut timings: Timings = Vec::new();
    for (name, seconds) in spent {
        // A stage may come again.
        match timings.iter_mut().find(|(known, _)| *known == name) {
            Some((_, sum)) => *sum += seconds,
            None => timings.push((name, seconds)),
        }
    }
    timings
}
