// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lets threads be in this module when the interpreter ends, such as daemon threads. In this
// module, the linker replaces the functions of the C++ library by these (--wrap in CMakeLists.txt).

#include <unistd.h>
#include <unwind.h>

// NOLINTBEGIN(bugprone-reserved-identifier): the linker's names
extern "C" {

_Unwind_Reason_Code __real___gxx_personality_v0(int version, _Unwind_Action actions,
                                                _Unwind_Exception_Class kind, _Unwind_Exception* exception,
                                                _Unwind_Context* context);

// Called for each function of this module through which the stack is unwound, before its destructors run.
//
// Python before 3.14 ends a thread that takes the GIL during finalization by pthread_exit(), which unwinds
// the stack. Calls of Python and numpy take the GIL, too, if they have released it. The unwinding would abort
// in a destructor, and would run other destructors, which release Python's objects, without the GIL. So the
// thread waits here for the end of the process, as it does in Python 3.14.
_Unwind_Reason_Code __wrap___gxx_personality_v0(int version, _Unwind_Action actions,
                                                _Unwind_Exception_Class kind, _Unwind_Exception* exception,
                                                _Unwind_Context* context) {
  while ((actions & _UA_FORCE_UNWIND) != 0)
    ::pause();
  return __real___gxx_personality_v0(version, actions, kind, exception, context);
}

// Registers the destructor of a static object. Does nothing: a thread that computes without the GIL uses
// static objects until the process ends.
int __wrap___cxa_atexit(void (*)(void*), void*, void*) {
  return 0;
}

}  // extern "C"
// NOLINTEND(bugprone-reserved-identifier)
