#!/bin/sh
# Installs what rootq needs and this machine lacks: tools/install.sh audit|test
#
#   audit   Rust, a C++ compiler (glslang), the Vulkan loader, a Vulkan driver
#   test    the same with lavapipe as the driver, the Khronos validation layer, and SwiftShader in target/swiftshader/
#
# Tests for the parts themselves, not for package names: a loader or driver from elsewhere serves as well. Where nothing is
# missing, no package manager is called. Only root can install; anybody else gets one line that names what to install.
# ROOTQ_VULKAN_DIRS (colon-separated) replaces the folders in which drivers and layers are looked for.
set -eu

cd "$(dirname "$0")/.."

swiftshader=target/swiftshader
vulkan_dirs=${ROOTQ_VULKAN_DIRS:-/usr/share/vulkan:/usr/local/share/vulkan:/etc/vulkan:${XDG_DATA_HOME:-${HOME:-}/.local/share}/vulkan}
# ldconfig lives in sbin, which an ordinary user's PATH leaves out.
PATH=$PATH:/usr/sbin:/sbin
export DEBIAN_FRONTEND=noninteractive

say() {
	printf '%s\n' "$*" >&2
}

# The machine is at fault: exit status 2, as from rootq itself.
die() {
	say "$@"
	exit 2
}

is_root() {
	[ "$(id -u)" -eq 0 ]
}

has_command() {
	command -v "$1" >/dev/null 2>&1
}

# in_path PATH FILE: does one folder of the colon-separated PATH hold FILE?
in_path() (
	IFS=:
	for dir in $1; do
		[ -e "$dir/$2" ] && exit 0
	done
	exit 1
)

# has_manifest SUBFOLDER PREFIX: is there a PREFIX*.json where the Vulkan loader looks?
has_manifest() (
	IFS=:
	for dir in $vulkan_dirs; do
		for file in "$dir/$1/$2"*.json; do
			[ -e "$file" ] && exit 0
		done
	done
	exit 1
)

has_loader() {
	in_path "${LD_LIBRARY_PATH:-}" libvulkan.so.1 || ldconfig -p 2>/dev/null | grep -q 'libvulkan\.so\.1 '
}

has_any_driver() {
	[ -n "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}${VK_ADD_DRIVER_FILES:-}" ] || has_manifest icd.d ''
}

has_validation_layer() {
	in_path "${VK_LAYER_PATH:-}:${VK_ADD_LAYER_PATH:-}" VkLayer_khronos_validation.json ||
		has_manifest explicit_layer.d VkLayer_khronos_validation
}

# CXX may carry a launcher and flags ("ccache g++ -m64"); its first word must exist.
has_cxx() {
	# shellcheck disable=SC2086
	set -- ${CXX:-c++}
	has_command "$1"
}

# need DEBIAN_PACKAGE WORDS: adds to what is missing.
need() {
	packages="${packages:+$packages }$1"
	parts="${parts:+$parts, }$2"
}

# list_missing PURPOSE: sets packages (Debian's names) and parts (the same in words).
list_missing() {
	packages=
	parts=
	has_cxx || need g++ 'a C++ compiler'
	has_loader || need libvulkan1 'the Vulkan loader (libvulkan.so.1)'
	case $1 in
	audit)
		has_any_driver || need mesa-vulkan-drivers 'a Vulkan driver'
		;;
	test)
		has_manifest icd.d lvp_icd || need mesa-vulkan-drivers "Mesa's lavapipe driver"
		has_validation_layer || need vulkan-validationlayers 'the Khronos validation layer'
		;;
	esac
}

require_rust() {
	wanted=$(sed -n 's/^rust-version = "\(.*\)"$/\1/p' Cargo.toml)
	version=$(cargo --version 2>/dev/null) ||
		die "rootq needs Rust $wanted or newer, and there is no working cargo; install it with rustup (https://rustup.rs)"
	minor=$(printf '%s\n' "$version" | sed -n 's/^cargo 1\.\([0-9]*\)\..*/\1/p')
	if [ -n "$minor" ] && [ "$minor" -lt "${wanted#1.}" ]; then
		die "rootq needs Rust $wanted or newer, and this is $version; update it: rustup update"
	fi
}

# logged WORDS COMMAND...: runs a command quietly; its output is shown only where it fails.
logged() {
	what=$1
	shift
	if ! "$@" >"$scratch/log" 2>&1; then
		cat "$scratch/log" >&2
		die "rootq: $what failed; the lines above say why"
	fi
}

apt() {
	# Another apt may hold the lock for a while: a first boot, an unattended upgrade.
	apt-get -q -y -o DPkg::Lock::Timeout=120 "$@"
}

install_packages() {
	list_missing "$1"
	[ -n "$packages" ] || return 0
	has_command apt-get || die "rootq needs $parts; install with this system's package manager"
	if ! is_root; then
		case $packages in
		*' '*) die "rootq needs the packages $packages; install them: sudo apt-get install -y $packages" ;;
		*) die "rootq needs the package $packages; install it: sudo apt-get install -y $packages" ;;
		esac
	fi
	say "rootq: installing $packages"
	logged 'apt-get update' apt update
	# shellcheck disable=SC2086
	logged "installing $packages" apt install --no-install-recommends $packages
	list_missing "$1"
	[ -z "$packages" ] || die "rootq still lacks $parts, although its packages are installed"
}

# Debian ships SwiftShader, a second Vulkan driver for the CPU, inside the browser's package. Two files of it are enough,
# so the package is unpacked, never installed.
install_swiftshader() {
	library=libvk_swiftshader.so
	manifest=vk_swiftshader_icd.json
	if [ -e "$swiftshader/$library" ] && [ -e "$swiftshader/$manifest" ]; then
		return 0
	fi
	if ! has_command apt-get || ! has_command dpkg-deb; then
		die "rootq's tests need SwiftShader as a second driver; put $library and $manifest into $swiftshader/"
	fi
	if is_root && ! knows_chromium; then
		logged 'apt-get update' apt update
	fi
	knows_chromium ||
		die "rootq's tests need SwiftShader from Debian's chromium-common, which apt does not know here;" \
			"run sudo apt-get update, or put $library and $manifest into $swiftshader/"
	say "rootq: unpacking SwiftShader from Debian's chromium-common into $swiftshader/"
	if is_root && ! download_chromium >"$scratch/log" 2>&1; then
		# The lists may name a version which the mirror has replaced.
		logged 'apt-get update' apt update
	fi
	logged 'downloading chromium-common' download_chromium
	mkdir -p "$swiftshader"
	logged 'unpacking chromium-common' unpack_chromium
	mv "$scratch/$library" "$scratch/$manifest" "$swiftshader/"
}

knows_chromium() {
	apt-cache show chromium-common >/dev/null 2>&1
}

download_chromium() (
	cd "$scratch/deb" && apt download chromium-common
)

unpack_chromium() {
	dpkg-deb --fsys-tarfile "$scratch"/deb/*.deb >"$scratch/tar"
	tar -x -f "$scratch/tar" -C "$scratch" --no-same-owner --wildcards --strip-components=4 \
		"./usr/lib/*/$library" "./usr/lib/*/$manifest"
}

case ${1:-} in
audit | test) ;;
*) die 'usage: tools/install.sh audit|test' ;;
esac

require_rust

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'exit 130' INT TERM HUP
mkdir "$scratch/deb"
# As root, apt downloads as the user _apt, who must reach and own the folder.
if is_root && id _apt >/dev/null 2>&1; then
	chmod 711 "$scratch"
	chown _apt "$scratch/deb"
fi

install_packages "$1"
if [ "$1" = test ]; then
	install_swiftshader
fi
