//! The Vulkan device: kernels on whatever physical device the loader lists.
//!
//! Ownership runs one way, and every child holds an `Arc` of its parent, so the order of destruction is by
//! construction and a value may outlive the [`VulkanDevice`] it came from:
//!
//! ```text
//! Loaded (instance, messenger) <- Logical (device) <- Memory <- Buffer <- Pool <- Engine
//!                                        ^----- Owned<handle> <- Lane <-------------'
//! Engine <- VulkanDevice, and Flight <- Pending, Inputs
//! Owned<pipeline>, Tables <- Program
//! ```
//!
//! Everything here is `Send` and `Sync` by its parts. What Vulkan wants synchronised from outside is covered
//! so: the queue is behind a mutex; a lane's command pool, descriptor pool, query pool and fence belong to
//! one submission at a time, which owns the lane by value; memory is allocated and freed behind a mutex;
//! pipelines, layouts, buffers and tables do not change after their creation.
#![allow(unsafe_code, reason = "Vulkan is a C interface; this module is its only safe face")]

mod adapter;
mod call;
mod capability;
mod columns;
mod engine;
mod flight;
mod image;
mod instance;
mod lane;
mod logical;
mod memory;
mod messages;
mod owned;
mod pace;
mod pool;
mod program;
mod select;
mod submission;
mod tables;
mod texel;
mod vulkan_device;

pub use columns::{Inputs, OutputColumns};

pub use instance::Instance;
pub use pool::Usage;
pub use program::Program;
pub use submission::Pending;
pub use vulkan_device::{Options, VulkanDevice};
