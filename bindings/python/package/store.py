# SPDX-License-Identifier: MIT
"""Stores: blobs under keys, changed in steps that are whole or not at all.

>>> store = cubemap.Store()
>>> with store:
...     store[b"block 7"] = b"some bytes"
>>> store[b"block 7"], list(store)
(b'some bytes', [b'block 7'])
"""

from __future__ import annotations

import ctypes
import threading
from collections.abc import Iterator, MutableMapping
from typing import Any, NamedTuple

from . import _library as library
from ._errors import Error
from ._texts import Changing, checked_kind, created, struct
from .camera import whole_number

KEY_BYTES_MOST = 255


class Blob(NamedTuple):
    """What a key has: its bytes, what kind they are of, and the version of their form."""

    data: bytes
    kind: int
    version: int


class Store(Changing, MutableMapping):
    """A store in memory, as a dictionary of bytes: s = Store(); s[b"block 7"] = b"..."; s.commit().

    kind, version   of what is put by s[key] = data; what is got by s[key] is of that kind and of a version not above
                    that

    Keys are 1 to 255 bytes, in the order of bytes. `with store:` commits at its end, or rolls back after an exception.
    Stores in files belong to the programs.

    >>> s = cubemap.Store(kind=3)
    >>> s[b"key"] = b"kept"
    >>> s.commit()
    >>> del s[b"key"]
    >>> s.rollback()
    >>> s.get_blob(b"key", kind=3)
    Blob(data=b'kept', kind=3, version=0)
    """

    def __init__(self, *, kind: int = 0, version: int = 0) -> None:
        self._handle = created(library.cm_store_create_in_memory, "cm_store_destroy")
        self._kind, self._version = whole_number(kind, "kind"), whole_number(version, "version")
        self._lock = threading.Lock()

    def _call(self, function, *arguments):
        """One thread at a time; what went wrong is in the store's own words, if it has some."""
        with self._lock:
            try:
                return function(self._handle, *arguments)
            except Error as error:
                message = library.cm_store_message(self._handle)
                raise Error(error.status, message.decode() if message else str(error)) from None

    def put_blob(self, key: bytes, blob: Blob) -> None:
        """Put a blob in the place of what the key has."""
        data = _bytes(checked_kind(blob, Blob, "blob").data, "data")
        given = struct(library.cm_blob, kind=whole_number(blob.kind, "kind"),
                       version=whole_number(blob.version, "version"), count=len(data),
                       data=ctypes.cast(ctypes.c_char_p(data), ctypes.c_void_p))
        self._call(library.cm_store_put, _key(key), ctypes.byref(given))

    def get_blob(self, key: bytes, kind: int, newest: int = 2**32 - 1) -> Blob | None:
        """The blob of a key, of a kind and of a version not above the newest that is known; None if there is none."""
        found = struct(library.cm_blob)
        self._call(library.cm_store_get, _key(key), whole_number(kind, "kind"), whole_number(newest, "newest"),
                   ctypes.byref(found))
        if not found.data:
            return None
        blob = Blob(ctypes.string_at(found.data, found.count), found.kind, found.version)
        library.cm_blob_clear(ctypes.byref(found))
        return blob

    def __getitem__(self, key: bytes) -> bytes:
        blob = self.get_blob(key, self._kind, self._version)
        if blob is None:
            raise KeyError(key)
        return blob.data

    def __setitem__(self, key: bytes, data: bytes) -> None:
        self.put_blob(key, Blob(data, self._kind, self._version))

    def __delitem__(self, key: bytes) -> None:
        if key not in self:
            raise KeyError(key)
        self._call(library.cm_store_remove, _key(key))

    def __contains__(self, key: object) -> bool:
        try:
            return self.get_blob(key, self._kind) is not None
        except Error as error:
            if error.status != library.CM_ERROR_DATA:
                raise
            return True  # of another kind

    def _next(self, after):
        found, count = ctypes.create_string_buffer(KEY_BYTES_MOST), ctypes.c_size_t()
        self._call(library.cm_store_next, _key(after) if after else None, found, ctypes.byref(count))
        return found.raw[:count.value]

    def __iter__(self) -> Iterator[bytes]:
        key = b""
        while key := self._next(key):
            yield key

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __repr__(self):
        return f"<cubemap.Store of {len(self)} keys>"

    def commit(self) -> None:
        """Keep what was put and removed since the last commit."""
        self._call(library.cm_store_commit)

    def rollback(self) -> None:
        """Forget what was put and removed since the last commit."""
        self._call(library.cm_store_rollback)

    def __enter__(self) -> Store:
        return self

    def __exit__(self, kind: Any, *rest: Any) -> None:
        if kind is None:
            self.commit()
        else:
            self.rollback()


def _bytes(data, what):
    if not isinstance(data, (bytes, bytearray, memoryview)):
        raise TypeError(f"{what}: bytes, not {type(data).__name__}")
    return bytes(data)


def _key(key):
    """A key for the library, which refuses what is none."""
    data = _bytes(key, "key")
    made = library.cm_store_key(ctypes.cast(ctypes.c_char_p(data), ctypes.c_void_p), len(data))
    made.kept = data
    return ctypes.byref(made)
