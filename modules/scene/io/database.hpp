// SPDX-License-Identifier: MIT
//
// A database of SQLite and its statements, whose failures name the file.

#ifndef CUBEMAP_MODULES_SCENE_DATABASE_HPP
#define CUBEMAP_MODULES_SCENE_DATABASE_HPP

#include <cubemap/store.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include <sqlite3.h>

class Statement;

// Open, and locked from others: FileFailure if that cannot be.
class Database
{
public:
    Database(const std::string &path, bool create);
    ~Database();
    Database(const Database &) = delete;
    Database &operator=(const Database &) = delete;

    void run(const std::string &text);
    std::int64_t number(const char *text);
    // A statement that is made once. The text is a constant.
    Statement &kept(const char *text);
    // Nothing is read any more.
    void reset_all() noexcept;

    bool in_transaction() const noexcept
    {
        return sqlite3_get_autocommit(handle) == 0;
    }
    std::int64_t last_number() const noexcept
    {
        return sqlite3_last_insert_rowid(handle);
    }
    int changes() const noexcept
    {
        return sqlite3_changes(handle);
    }
    const std::string &name() const noexcept
    {
        return path;
    }
    sqlite3 *get() const noexcept
    {
        return handle;
    }
    // What SQLite's number means.
    [[noreturn]] void fail(int result) const;

private:
    void prepare();
    bool has_moved() const;

    std::string path;
    sqlite3 *handle = nullptr;
    std::map<const char *, std::unique_ptr<Statement>> statements;
};

class Statement
{
public:
    Statement(Database &from, const char *text);
    ~Statement()
    {
        sqlite3_finalize(handle);
    }
    Statement(const Statement &) = delete;
    Statement &operator=(const Statement &) = delete;

    // Bytes must live until the statement is reset.
    void bind(int place, const void *bytes, std::size_t count);
    void bind(int place, std::int64_t number);
    // Is there a row? Without one the statement is reset.
    bool step();
    // A statement without rows.
    void finish();
    void reset() noexcept
    {
        sqlite3_reset(handle);
    }

    // Of the row. Bytes live until the next step. FileFailure if the column holds something else.
    std::int64_t number(int column);
    std::string text(int column);
    cm_store_key key(int column);

private:
    Database &database;
    sqlite3_stmt *handle = nullptr;
};

#endif
