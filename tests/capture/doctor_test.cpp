// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/doctor.h"

#include <gmock/gmock.h>

#include "tests/support/file_edits.h"
#include "tests/support/temporary_folder.h"

namespace rakelight::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

UsbSensor usb_sensor(std::uint16_t vendor, std::uint16_t product, UsbAccess access = UsbAccess::usable) {
  UsbSensor sensor;
  sensor.vendor = vendor;
  sensor.product = product;
  sensor.kind = known_sensor(vendor, product).value();
  sensor.bus = 2;
  sensor.address = 5;
  sensor.megabits = 480;
  sensor.access = access;
  return sensor;
}

Hardware healthy() {
  Hardware hardware;
  hardware.sensors = {usb_sensor(0x1d27, 0x0601)};
  hardware.sensor_users = {{}};
  hardware.openni.version = "2.2.0.33";
  hardware.openni.drivers = {"/usr/lib/OpenNI2/Drivers", {"libPS1080.so.0", "libPSLink.so.0"}, {}};
  hardware.openni.devices = {{"1d27/0601@2/5", "PrimeSense", "PS1080", "1d27:0601"}};
  hardware.chips = {{"/dev/gpiochip0", "gpiochip0", "cp2112_gpio", {}, {}}};
  for (unsigned offset = 0; offset < 4; ++offset)
    hardware.chips[0].lines.push_back({offset, "", "", false, false, false});
  return hardware;
}

Rig two_lamps() {
  Rig rig;
  rig.lamps = {{"left", LampColor::white, {"", "cp2112_gpio", 0, false}, {}},
               {"right", LampColor::white, {"", "cp2112_gpio", 1, false}, {}}};
  return rig;
}

/// "subject: what; cure" of every problem.
std::vector<std::string> problems(const Hardware& hardware, const Rig* rig = nullptr) {
  std::vector<std::string> texts;
  for (const Finding& finding : diagnose(hardware, rig)) {
    if (finding.level == Finding::Level::problem)
      texts.push_back(finding.subject + ": " + finding.what + "; " + finding.cure);
  }
  return texts;
}

TEST(Doctor, FindsNothingWrongWithAHealthyRig) {
  const Rig rig = two_lamps();
  EXPECT_THAT(problems(healthy(), &rig), IsEmpty());
  EXPECT_THAT(problems(Hardware{{}, {}, healthy().openni, {}, {}}), IsEmpty())
      << "nothing plugged in, nothing wanted";
}

TEST(Doctor, GivesTheUdevRuleThatCuresMissingPermission) {
  Hardware hardware = healthy();
  hardware.sensors[0] = usb_sensor(0x2bc5, 0x0401, UsbAccess::denied);
  EXPECT_THAT(problems(hardware),
              Contains(AllOf(HasSubstr("no permission for /dev/bus/usb/002/005"),
                             HasSubstr(R"(SUBSYSTEM=="usb", ATTR{idVendor}=="2bc5", MODE="0660")"))));
}

TEST(Doctor, NamesWhoUsesABusySensor) {
  Hardware hardware = healthy();
  hardware.sensors[0].access = UsbAccess::busy;
  hardware.sensor_users = {{{4711, "NiViewer2"}}};
  EXPECT_THAT(problems(hardware), ElementsAre(HasSubstr("in use by NiViewer2 (process 4711)")));
}

TEST(Doctor, MindsASlowPort) {
  Hardware hardware = healthy();
  hardware.sensors[0].megabits = 12;
  EXPECT_THAT(problems(hardware), ElementsAre(HasSubstr("12 Mbit/s, too slow")));
}

TEST(Doctor, SaysWhatAnOrbbecCameraNeeds) {
  Hardware hardware = healthy();
  hardware.sensors[0] = usb_sensor(0x2bc5, 0x0402);
  EXPECT_THAT(problems(hardware),
              ElementsAre(AllOf(HasSubstr("liborbbec.so.0 is not in /usr/lib/OpenNI2/Drivers"),
                                HasSubstr("under exactly this name"))));
  hardware.openni.drivers.loaded.push_back("liborbbec.so.0");
  EXPECT_THAT(problems(hardware), IsEmpty());
  hardware.sensors[0] = usb_sensor(0x2bc5, 0x0670);
  EXPECT_THAT(problems(hardware), ElementsAre(HasSubstr("no OpenNI2 driver is known for it")));
}

TEST(Doctor, KnowsSensorsFromOtherUsbDevices) {
  for (const int product : {0x0500, 0x0600, 0x0601, 0x0609})
    EXPECT_EQ(known_sensor(0x1d27, static_cast<std::uint16_t>(product)).value().driver, "libPS1080.so.0");
  EXPECT_EQ(known_sensor(0x1d27, 0x1280).value().driver, "libPSLink.so.0");
  EXPECT_FALSE(known_sensor(0x1d6b, 0x0002)) << "a root hub";
  EXPECT_FALSE(known_sensor(0x2bc5, 0x0501)) << "the colour half of an Astra Pro";
}

TEST(Doctor, MissesTheSensorTheRigNames) {
  Rig rig = two_lamps();
  rig.sensor.uri = "1d27/0609@1/2";
  EXPECT_THAT(problems(healthy(), &rig), ElementsAre(HasSubstr("OpenNI2 sees no 1d27/0609@1/2")));
  rig.sensor.uri.clear();
  Hardware unplugged = healthy();
  unplugged.openni.devices.clear();
  EXPECT_THAT(problems(unplugged, &rig), ElementsAre(HasSubstr("rig's sensor: OpenNI2 sees no device")));
}

TEST(Doctor, MissesALampsChip) {
  const Rig rig = two_lamps();
  Hardware hardware = healthy();
  hardware.chips[0].label = "ftdi-cbus";
  EXPECT_THAT(
      problems(hardware, &rig),
      ElementsAre(AllOf(HasSubstr("lamp left: "), HasSubstr("gpiochip0 (ftdi-cbus); plug the board in"),
                        Not(HasSubstr("No such device"))),
                  HasSubstr("lamp right: ")));
}

TEST(Doctor, NamesWhoHoldsABusyLine) {
  const Rig rig = two_lamps();
  Hardware hardware = healthy();
  hardware.chips[0].lines[1].used = true;
  hardware.chips[0].lines[1].consumer = "gpioset";
  hardware.line_holders = {{99, "gpioset"}};
  EXPECT_THAT(
      problems(hardware, &rig),
      ElementsAre(AllOf(HasSubstr("lamp right: line 1 of gpiochip0 (cp2112_gpio) is held by 'gpioset'"),
                        HasSubstr("gpioset (process 99)"))));
}

TEST(Doctor, NeedsNoHardwareForAVirtualRig) {
  const Rig rig = virtual_rig();
  Hardware hardware = healthy();
  hardware.sensors.clear();
  hardware.openni.devices.clear();
  EXPECT_THAT(problems(hardware, &rig), IsEmpty());
}

TEST(OpenniDrivers, TellsLoadedFromPassedOver) {
  const TemporaryFolder folder;
  for (const std::string name :
       {"libPS1080.so.0", "libPS1080.so", "liborbbec.so", "orbbec.ini", "PSLink.so.0"})
    set_text(folder / name, "");
  const OpenniDrivers drivers = list_openni_drivers(folder.path());
  EXPECT_THAT(drivers.loaded, ElementsAre("libPS1080.so.0"));
  EXPECT_THAT(drivers.skipped, ElementsAre("liborbbec.so"));
  EXPECT_THAT(list_openni_drivers(folder / "none").loaded, IsEmpty());
}

TEST(OpenFiles, FindsTheProcessesThatHoldADevice) {
  const TemporaryFolder proc;
  for (const std::string pid : {"20", "3", "self"}) {
    std::filesystem::create_directories(proc / (pid + "/fd"));
    set_text(proc / (pid + "/comm"), "gpioset\n");
  }
  std::filesystem::create_symlink("anon_inode:gpio-linehandle", proc / "3/fd/5");
  std::filesystem::create_symlink("/dev/null", proc / "20/fd/5");
  const auto holders = processes_with_open("anon_inode:gpio-line", proc.path());
  EXPECT_EQ(to_string(holders), "gpioset (process 3)");
}

}  // namespace
}  // namespace rakelight::test
