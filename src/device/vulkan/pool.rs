//! Buffers used again and again.
//!
//! A run evaluates hundreds of equal chunks. Fresh memory costs a page fault every 4 KiB, which on a software
//! device is as dear as the kernel itself; so a buffer that is no longer needed waits here for the next
//! chunk.

use std::ops::{Deref, DerefMut};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

use super::call::lock;
use super::memory::{Buffer, Memory, Role};
use crate::device::Error;

/// Idle buffers beyond this many bytes are freed.
const IDLE_LIMIT: u64 = 1 << 30;

/// How a device's buffers have been used so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Usage {
    /// Buffers made from fresh memory.
    pub created: u64,
    /// Buffers handed out again.
    pub recycled: u64,
}

/// The idle buffers of one device.
pub(super) struct Pool {
    memory: Arc<Memory>,
    idle: Mutex<Vec<Idle>>,
    created: AtomicU64,
    recycled: AtomicU64,
}

struct Idle {
    role: Role,
    bytes: u64,
    buffer: Buffer,
}

impl Pool {
    pub(super) fn new(memory: Arc<Memory>) -> Arc<Self> {
        Arc::new(Self {
            memory,
            idle: Mutex::default(),
            created: AtomicU64::new(0),
            recycled: AtomicU64::new(0),
        })
    }

    /// The memory that buffers come from.
    pub(super) fn memory(&self) -> &Arc<Memory> {
        &self.memory
    }

    pub(super) fn usage(&self) -> Usage {
        Usage {
            created: self.created.load(Ordering::Relaxed),
            recycled: self.recycled.load(Ordering::Relaxed),
        }
    }

    /// A buffer of at least `bytes`, with unspecified contents.
    pub(super) fn lease(self: &Arc<Self>, role: Role, bytes: u64) -> Result<Lease, Error> {
        let bytes = size_class(bytes);
        let mut idle = lock(&self.idle);
        let found = idle.iter().rposition(|idle| idle.role == role && idle.bytes == bytes);
        let buffer = found.map(|index| idle.swap_remove(index).buffer);
        drop(idle);
        let buffer = match buffer {
            Some(buffer) => {
                self.recycled.fetch_add(1, Ordering::Relaxed);
                buffer
            }
            None => self.create(role, bytes)?,
        };
        Ok(Lease { buffer: Some(buffer), role, bytes, pool: Arc::clone(self) })
    }

    fn create(&self, role: Role, bytes: u64) -> Result<Buffer, Error> {
        let buffer = match Buffer::new(&self.memory, role, bytes) {
            Ok(buffer) => buffer,
            // Idle buffers of other sizes may be what is missing.
            Err(_) => {
                drop(std::mem::take(&mut *lock(&self.idle)));
                Buffer::new(&self.memory, role, bytes)?
            }
        };
        self.created.fetch_add(1, Ordering::Relaxed);
        Ok(buffer)
    }

    fn give_back(&self, returned: Idle) {
        let mut idle = lock(&self.idle);
        let bytes: u64 = idle.iter().map(|idle| idle.bytes).sum();
        if bytes + returned.bytes <= IDLE_LIMIT {
            idle.push(returned);
        }
    }
}

/// `bytes` rounded up to an eighth of its power of two, and to a page: few classes, at most an eighth wasted.
fn size_class(bytes: u64) -> u64 {
    let step = (bytes.max(1).next_power_of_two() / 16).max(4096);
    bytes.max(1).next_multiple_of(step)
}

/// A buffer on loan; it goes back on drop.
pub(super) struct Lease {
    /// `None` only while dropping.
    buffer: Option<Buffer>,
    role: Role,
    bytes: u64,
    pool: Arc<Pool>,
}

impl Lease {
    pub(super) fn is_of(&self, pool: &Arc<Pool>) -> bool {
        Arc::ptr_eq(&self.pool, pool)
    }
}

impl Deref for Lease {
    type Target = Buffer;

    fn deref(&self) -> &Buffer {
        self.buffer.as_ref().expect("a lease has its buffer until it is dropped")
    }
}

impl DerefMut for Lease {
    fn deref_mut(&mut self) -> &mut Buffer {
        self.buffer.as_mut().expect("a lease has its buffer until it is dropped")
    }
}

impl Drop for Lease {
    fn drop(&mut self) {
        if let Some(buffer) = self.buffer.take() {
            self.pool.give_back(Idle { role: self.role, bytes: self.bytes, buffer });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::size_class;

    #[test]
    fn size_classes_hold_and_waste_little() {
        for bytes in [0, 1, 4, 4095, 4096, 4097, 65_537, 1_000_003 * 24, (1 << 20) * 32, (1 << 25) + 1] {
            let class = size_class(bytes);
            assert!(class >= bytes && class <= bytes + bytes / 8 + 4096, "{bytes} -> {class}");
            assert_eq!(size_class(class), class, "a class is its own class");
        }
        assert_eq!(size_class((1 << 20) * 24), (1 << 20) * 24, "a full chunk of six columns wastes nothing");
    }
}
