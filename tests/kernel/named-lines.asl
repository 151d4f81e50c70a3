// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A GPIO chip whose lines have names, as a board's firmware would describe one: the kernel's gpio-amdpt driver drives it,
// its registers are a page of memory that run_in_vm keeps the kernel from using otherwise.
DefinitionBlock ("", "SSDT", 2, "RAKE", "LAMPS", 1)
{
    Device (\_SB.LAMP)
    {
        Name (_HID, "AMDIF030")
        Name (_CRS, ResourceTemplate () { Memory32Fixed (ReadWrite, 0x1F000000, 0x1000) })
        Name (_DSD, Package ()
        {
            ToUUID ("daffd814-6eba-4d8c-8a91-bc9bbf4aa301"),
            Package ()
            {
                Package ()
                {
                    "gpio-line-names",
                    Package () { "lamp-left", "lamp-right", "", "fan", "lamp-top", "twin", "twin", "" }
                }
            }
        })
    }
}
