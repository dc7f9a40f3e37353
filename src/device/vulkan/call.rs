//! Vulkan results that keep the name of the call they came from.

use std::sync::{Mutex, MutexGuard, PoisonError};

use ash::vk;

use crate::device::Error;

/// Names a result's call.
pub(super) trait Named<T> {
    /// The same result, its error an [`Error::Call`] that names the Vulkan function.
    fn named(self, call: &'static str) -> Result<T, Error>;
}

impl<T> Named<T> for Result<T, vk::Result> {
    fn named(self, call: &'static str) -> Result<T, Error> {
        // Debug, not Display: the code's own name (ERROR_DEVICE_LOST) is what people search for.
        self.map_err(|result| Error::Call { call, result: format!("{result:?}") })
    }
}

/// Locks, also after a panic elsewhere: what these mutexes guard is valid between any two statements.
pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
