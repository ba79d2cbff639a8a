# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
from typing import Any, Dict, List, Literal, Optional, Sequence, Union

from numpy.typing import ArrayLike

from . import Up

class Error(RuntimeError): ...

def devices() -> List[Dict[str, Any]]: ...

class Device:
    def __init__(self, which: Union[int, str] = "auto") -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def number(self) -> int: ...
    @property
    def lost(self) -> bool: ...

class Cloud:
    def __init__(self, points: ArrayLike, device: Device, *, threads: int = 1) -> None: ...
    def __len__(self) -> int: ...
    def fit(
        self,
        method: Union[str, Sequence[str]],
        offsets: Optional[Sequence[int]] = None,
        *,
        up: Up = "z",
        growth: Literal["sequential", "stationary", "deferred"] = "deferred",
        concave_length: Optional[float] = None,
        threads: int = 1,
    ) -> Any: ...
