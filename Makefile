# rootq: `make help` lists the targets.

# The first device is the default; select, count and more through ARGS: make audit ARGS="--device llvmpipe -n 100K"
ARGS ?=

SHELL := /bin/sh
TARGET_DIR := $(or $(CARGO_TARGET_DIR),target)
# rustup's default place, for shells that have not read its profile.
export PATH := $(PATH):$(or $(CARGO_HOME),$(HOME)/.cargo)/bin

# Only the release profile is ever built: a second profile would compile glslang, minutes of C++, once more.
CARGO_FLAGS := --release --locked

# $(call if_component,COMPONENT,SUBCOMMAND,ARGUMENTS): runs a part of the toolchain, or says that it is absent and goes on.
define if_component
@if cargo $(2) --version >/dev/null 2>&1; then \
	echo 'cargo $(2) $(3)'; \
	cargo $(2) $(3); \
else \
	echo 'skipped: cargo $(2) (this toolchain lacks $(1); add it: rustup component add $(1))' >&2; \
fi
endef

.PHONY: help audit test golden clean

help:
	@echo 'make audit    install what is missing, build, audit and time every built-in variant on the first device'
	@echo '              more or less of it: make audit ARGS="ellipse_axes --device llvmpipe -n 100K"'
	@echo 'make test     install what is missing, then format, lints, tests and documentation'
	@echo 'make golden   write tests/golden anew (python3 with mpmath); tools/golden.py --check only compares'
	@echo 'make clean    remove all that was built'

audit:
	@tools/install.sh audit
	cargo build $(CARGO_FLAGS)
	$(TARGET_DIR)/release/rootq run $(ARGS)

test:
	@tools/install.sh test
	$(call if_component,rustfmt,fmt,--check)
	$(call if_component,clippy,clippy,$(CARGO_FLAGS) --all-targets -- -D warnings)
	cargo test $(CARGO_FLAGS)
	RUSTDOCFLAGS=-Dwarnings cargo doc $(CARGO_FLAGS) --no-deps

golden:
	@command -v python3 >/dev/null || { echo 'make golden needs python3 and mpmath (Debian: python3-mpmath)' >&2; exit 2; }
	python3 tools/golden.py

clean:
	cargo clean
