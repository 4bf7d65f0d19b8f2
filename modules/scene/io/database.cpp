// SPDX-License-Identifier: MIT

#include "database.hpp"

#include "file_failure.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <initializer_list>

#include <sys/stat.h>
#ifdef __linux__
#include <sys/vfs.h>
#endif

namespace
{

// File systems of other machines, whose locks SQLite cannot trust ("How To Corrupt An SQLite Database File", section 2.1):
// NFS, SMB, CIFS, SMB2, AFS, 9P, Ceph, by the numbers of statfs(2).
bool is_of_another_machine(const std::string &path)
{
#ifdef __linux__
    struct statfs status;
    const std::size_t slash = path.find_last_of('/');
    const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
    if (statfs(folder.c_str(), &status) != 0)
    {
        return false;
    }
    const std::array<unsigned long, 6> remote = {0x6969,     0x517B,     0xFF534D42,
                                                 0xFE534D42, 0x5346414F, 0x00C36400};
    const unsigned long type = static_cast<unsigned long>(status.f_type) & 0xFFFFFFFFul;
    return std::find(remote.begin(), remote.end(), type) != remote.end();
#else
    (void)path;
    return false;
#endif
}

void check_place(const std::string &path, bool create)
{
    struct stat status;
    const bool there = stat(path.c_str(), &status) == 0;
    if (!there && (!create || errno != ENOENT))
    {
        fail_system(path, "cannot be opened");
    }
    if (there && !S_ISREG(status.st_mode))
    {
        fail_file(path, "is not a file", CM_ERROR_FILE);
    }
    if (is_of_another_machine(path))
    {
        fail_file(path, "is on a disk of another machine; stores need a local one", CM_ERROR_FILE);
    }
}

} // namespace

Database::Database(const std::string &file, bool create) : path(file)
{
    check_place(path, create);
    // a name that SQLite takes for something else, as ":memory:" or "file:folder/name?mode=ro", is a file all the same
    const std::string plain = path.compare(0, 1, "/") == 0 ? path : "./" + path;
    const int flags = SQLITE_OPEN_READWRITE | (create ? SQLITE_OPEN_CREATE : 0) |
                      SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE;
    const int result = sqlite3_open_v2(plain.c_str(), &handle, flags, nullptr);
    try
    {
        if (result != SQLITE_OK)
        {
            fail(result);
        }
        prepare();
    }
    catch (...)
    {
        statements.clear();
        sqlite3_close(handle);
        throw;
    }
}

// A rollback journal, not a log that is written ahead: the store is one file when nobody writes, and has not grown by a log
// that waits to be taken in; there are no readers beside the writer, for whom a log would be. TRUNCATE, since the commit is
// then the journal's new length, which synchronous=FULL brings to the disk; of DELETE it is the folder's entry, which it does
// not.
void Database::prepare()
{
    if (sqlite3_db_readonly(handle, "main") == 1)
    {
        fail_file(path, "cannot be written", CM_ERROR_FILE);
    }
    sqlite3_busy_timeout(handle, 0);
    sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    for (const char *const text : {"PRAGMA locking_mode=EXCLUSIVE", "PRAGMA synchronous=FULL",
                                   "PRAGMA cell_size_check=ON", "PRAGMA temp_store=MEMORY"})
    {
        run(text);
    }
    std::string mode;
    {
        Statement ask(*this, "PRAGMA journal_mode");
        mode = ask.step() ? ask.text(0) : "";
    }
    if (mode == "wal")
    {
        fail_file(path, "is a database of another program, or damaged: stores have no log");
    }
    run("PRAGMA journal_mode=TRUNCATE");
}

// Has the file, since it was opened, come to another name or to none?
bool Database::has_moved() const
{
    int moved = 0;
    return sqlite3_file_control(handle, "main", SQLITE_FCNTL_HAS_MOVED, &moved) == SQLITE_OK &&
           moved != 0;
}

Database::~Database()
{
    reset_all();
    sqlite3_exec(handle, "ROLLBACK", nullptr, nullptr, nullptr);
    // The journal goes away when it is asked for by who does not hold the file. By its name: where the file has none or another
    // by now, that is the journal of whoever has made a file there since, and what they need after a kill.
    if (!has_moved())
    {
        for (const char *const text : {"PRAGMA locking_mode=NORMAL", "PRAGMA journal_mode=DELETE"})
        {
            sqlite3_exec(handle, text, nullptr, nullptr, nullptr);
        }
    }
    statements.clear();
    sqlite3_close(handle);
}

void Database::fail(int result) const
{
    const std::string words = handle == nullptr ? sqlite3_errstr(result) : sqlite3_errmsg(handle);
    switch (result & 0xff)
    {
    case SQLITE_NOMEM:
        throw std::bad_alloc();
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
        fail_file(path, "is in use: a store has one user at a time", CM_ERROR_FILE);
    case SQLITE_FULL:
        fail_file(path, "the disk is full; nothing is changed", CM_ERROR_FILE);
    case SQLITE_NOTADB:
        fail_file(path, "is not a store");
    case SQLITE_CANTOPEN:
        errno = sqlite3_system_errno(handle);
        fail_system(path, "it, or the journal beside it, cannot be opened; nothing is changed");
    case SQLITE_READONLY:
        if (result == SQLITE_READONLY_DIRECTORY)
        {
            fail_file(path,
                      "its folder cannot be written, where its journal belongs; nothing is changed",
                      CM_ERROR_FILE);
        }
        [[fallthrough]];
    case SQLITE_IOERR:
    case SQLITE_PERM:
    case SQLITE_AUTH:
        fail_file(path, "cannot be read or written; nothing is changed: " + words, CM_ERROR_FILE);
    default:
        fail_file(path, "is damaged: " + words);
    }
}

void Database::run(const std::string &text)
{
    const int result = sqlite3_exec(handle, text.c_str(), nullptr, nullptr, nullptr);
    if (result != SQLITE_OK)
    {
        fail(result);
    }
}

std::int64_t Database::number(const char *text)
{
    Statement statement(*this, text);
    return statement.step() ? statement.number(0) : 0;
}

Statement &Database::kept(const char *text)
{
    std::unique_ptr<Statement> &statement = statements[text];
    if (!statement)
    {
        statement = std::make_unique<Statement>(*this, text);
    }
    statement->reset();
    return *statement;
}

void Database::reset_all() noexcept
{
    for (const auto &each : statements)
    {
        if (each.second)
        {
            each.second->reset();
        }
    }
}

Statement::Statement(Database &from, const char *text) : database(from)
{
    const int result = sqlite3_prepare_v2(from.get(), text, -1, &handle, nullptr);
    if (result != SQLITE_OK)
    {
        from.fail(result);
    }
}

void Statement::bind(int place, const void *bytes, std::size_t count)
{
    // no bytes are a blob of none, not NULL
    const int result =
        sqlite3_bind_blob64(handle, place, bytes == nullptr ? "" : bytes, count, SQLITE_STATIC);
    if (result != SQLITE_OK)
    {
        database.fail(result);
    }
}

void Statement::bind(int place, std::int64_t number)
{
    const int result = sqlite3_bind_int64(handle, place, number);
    if (result != SQLITE_OK)
    {
        database.fail(result);
    }
}

bool Statement::step()
{
    const int result = sqlite3_step(handle);
    if (result != SQLITE_ROW && result != SQLITE_DONE)
    {
        database.fail(result);
    }
    if (result == SQLITE_DONE)
    {
        reset();
    }
    return result == SQLITE_ROW;
}

void Statement::finish()
{
    while (step())
    {
    }
}

std::int64_t Statement::number(int column)
{
    if (sqlite3_column_type(handle, column) != SQLITE_INTEGER)
    {
        fail_file(database.name(), "is damaged: a number is none");
    }
    return sqlite3_column_int64(handle, column);
}

std::string Statement::text(int column)
{
    const unsigned char *const text = sqlite3_column_text(handle, column);
    return text == nullptr ? "" : reinterpret_cast<const char *>(text);
}

cm_store_key Statement::key(int column)
{
    if (sqlite3_column_type(handle, column) != SQLITE_BLOB)
    {
        fail_file(database.name(), "is damaged: a column has other values");
    }
    const void *const bytes = sqlite3_column_blob(handle, column);
    const int count = sqlite3_column_bytes(handle, column);
    return {bytes == nullptr ? "" : bytes, static_cast<std::size_t>(count)};
}
