//! Threads for loops over data, in processes made by `fork` too.

use std::sync::{Mutex, OnceLock};

use rayon::ThreadPool;

/// The process that loaded this module, whose threads are rayon's own.
static FIRST: OnceLock<u32> = OnceLock::new();

/// The pool of a process that was forked from it: the first one's threads are not there any more, and would be waited for.
static FORKED: Mutex<Option<(u32, ThreadPool)>> = Mutex::new(None);

/// Remembers in which process we are.
pub(crate) fn begin() {
    FIRST.get_or_init(std::process::id);
}

/// Does `work` where loops over data find threads that are there; `None` if the system gives none.
pub(crate) fn with_threads<T: Send>(work: impl FnOnce() -> T + Send) -> Option<T> {
    let here = std::process::id();
    if FIRST.get().is_none_or(|first| *first == here) {
        return Some(work());
    }
    // Somebody else may have been in here when the process was forked, who is gone as well.
    let Ok(mut pool) = FORKED.try_lock() else {
        return Some(rayon::ThreadPoolBuilder::new().build().ok()?.install(work));
    };
    if pool.as_ref().is_none_or(|(process, _)| *process != here) {
        // To end a pool is to wake its threads, and these are gone.
        std::mem::forget(pool.take());
        *pool = Some((here, rayon::ThreadPoolBuilder::new().build().ok()?));
    }
    let (_, threads) = pool.as_ref()?;
    Some(threads.install(work))
}
