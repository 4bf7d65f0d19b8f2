// SPDX-License-Identifier: MIT

#include "store_file.h"

#include "blob_frame.hpp"
#include "check_sum.h"
#include "database.hpp"
#include "file_failure.hpp"

#include "modules/image/io/file_words.h"

#include <cstring>

namespace
{

// The keys, each with the number of its frame and the frame's sum, apart from the frames, so that all keys can be read and
// checked without them. The table whole has how many keys there are, and the sum of their rows: a row that damage has taken
// away is missed.
constexpr const char *directory_text =
    "CREATE TABLE directory(key BLOB PRIMARY KEY, frame INTEGER NOT NULL, sum INTEGER NOT NULL) "
    "WITHOUT ROWID";
constexpr const char *frames_text =
    "CREATE TABLE frames(number INTEGER PRIMARY KEY, bytes BLOB NOT NULL)";
constexpr const char *whole_text =
    "CREATE TABLE whole(number INTEGER PRIMARY KEY, keys INTEGER NOT NULL, sum INTEGER NOT NULL)";
constexpr std::int64_t application = 0x434d5354; // "CMST"
constexpr std::int64_t newest_version = 1;

std::string set_version_text()
{
    return "PRAGMA user_version=" + std::to_string(newest_version);
}

// What a row adds to the sum of all.
std::uint64_t row_sum(const cm_store_key &key, std::int64_t frame, std::uint64_t sum)
{
    unsigned char numbers[16];
    cm_file_put_u64(numbers, static_cast<std::uint64_t>(frame));
    cm_file_put_u64(numbers + 8, sum);
    return cm_check_sum(cm_check_sum(CM_CHECK_SUM_BEGIN, numbers, sizeof numbers), key.bytes,
                        key.count);
}

struct KeyTotals
{
    std::uint64_t keys = 0;
    std::uint64_t sum = 0;

    bool operator==(const KeyTotals &other) const noexcept
    {
        return keys == other.keys && sum == other.sum;
    }
};

class StoreFile
{
public:
    StoreFile(const std::string &path, const cm_store_file_options &options);

    void get(const cm_store_key &key, cm_blob &blob);
    void put(const cm_store_key &key, const cm_blob &blob);
    void remove(const cm_store_key &key);
    void next(const cm_store_key &after, unsigned char *key, std::size_t &count);
    void commit();
    void rollback();

    // Calls body, of a method that changes something if changes is true; what fails then is rolled back, and all changes
    // fail until rollback().
    template <typename Body> cm_status call(bool changes, const Body &body) noexcept;
    const char *message() const noexcept
    {
        return line;
    }

private:
    void make();
    void check_head();
    void check_directory();
    KeyTotals written_totals();
    void begin();
    void end_step();
    bool is_made();
    void keep_again();
    bool find(const cm_store_key &key, std::int64_t &frame, std::uint64_t &sum);

    Database database;
    BlobFrames frames;
    int level;
    KeyTotals totals;
    bool changing = false; // is there a transaction?
    cm_status stuck = CM_OK;
    char line[CM_IMAGE_MESSAGE] = "";
};

StoreFile::StoreFile(const std::string &path, const cm_store_file_options &options)
    : database(path, options.create != 0), level(options.level == 0 ? 3 : options.level)
{
    // before BEGIN, which gives an empty file its first page
    const bool empty = database.number("PRAGMA page_count") == 0;
    database.run("BEGIN EXCLUSIVE");
    if (empty)
    {
        if (options.create == 0)
        {
            fail_file(path, "is empty, and not a store");
        }
        make();
    }
    check_head();
    check_directory();
    database.run("COMMIT");
    if (options.page_most != 0)
    {
        database.run("PRAGMA max_page_count=" + std::to_string(options.page_most));
    }
}

void StoreFile::make()
{
    database.run("PRAGMA application_id=" + std::to_string(application));
    database.run(set_version_text());
    database.run(directory_text);
    database.run(frames_text);
    database.run(whole_text);
    database.run("INSERT INTO whole VALUES(1, 0, 0)");
}

void StoreFile::check_head()
{
    if (database.number("PRAGMA application_id") != application)
    {
        fail_file(database.name(), "is a database of another program, not a store");
    }
    const std::int64_t version = database.number("PRAGMA user_version");
    if (version > newest_version)
    {
        fail_file(database.name(),
                  "is a store of version " + std::to_string(version) +
                      "; this program knows version " + std::to_string(newest_version),
                  CM_ERROR_VERSION);
    }
    std::string texts;
    Statement all(database, "SELECT sql FROM sqlite_schema ORDER BY name");
    while (all.step())
    {
        texts += all.text(0) + ";";
    }
    const std::string ours =
        std::string(directory_text) + ";" + frames_text + ";" + whole_text + ";";
    if (version < 1 || texts != ours)
    {
        fail_file(database.name(), "is damaged: it has not the tables of a store");
    }
}

void StoreFile::check_directory()
{
    KeyTotals found;
    Statement rows(database, "SELECT key, frame, sum FROM directory");
    while (rows.step())
    {
        const cm_store_key key = rows.key(0);
        if (key.count < 1 || key.count > CM_STORE_KEY_MAX)
        {
            fail_file(database.name(), "is damaged: it has a key that is none");
        }
        ++found.keys;
        found.sum += row_sum(key, rows.number(1), static_cast<std::uint64_t>(rows.number(2)));
    }
    if (!(written_totals() == found))
    {
        fail_file(database.name(), "is damaged: the table of its keys is another one");
    }
    totals = found;
}

KeyTotals StoreFile::written_totals()
{
    Statement whole(database, "SELECT keys, sum FROM whole WHERE number = 1");
    if (!whole.step())
    {
        fail_file(database.name(), "is damaged: the number of its keys is not there");
    }
    return {static_cast<std::uint64_t>(whole.number(0)),
            static_cast<std::uint64_t>(whole.number(1))};
}

void StoreFile::begin()
{
    if (!changing)
    {
        database.run("BEGIN IMMEDIATE");
        changing = true;
    }
}

bool StoreFile::find(const cm_store_key &key, std::int64_t &frame, std::uint64_t &sum)
{
    Statement &row = database.kept("SELECT frame, sum FROM directory WHERE key = ?1");
    row.bind(1, key.bytes, key.count);
    if (!row.step())
    {
        return false;
    }
    frame = row.number(0);
    sum = static_cast<std::uint64_t>(row.number(1));
    row.reset();
    return true;
}

void StoreFile::get(const cm_store_key &key, cm_blob &blob)
{
    std::int64_t frame = 0;
    std::uint64_t sum = 0;
    if (!find(key, frame, sum))
    {
        return;
    }
    Statement &row = database.kept("SELECT bytes FROM frames WHERE number = ?1");
    row.bind(1, frame);
    if (!row.step())
    {
        fail_file(database.name(), "is damaged: a blob is not there");
    }
    const cm_store_key bytes = row.key(0);
    const char *const wrong =
        frames.unpack(key, static_cast<const unsigned char *>(bytes.bytes), bytes.count, sum, blob);
    row.reset();
    if (wrong != nullptr)
    {
        fail_file(database.name(), wrong);
    }
}

void StoreFile::put(const cm_store_key &key, const cm_blob &blob)
{
    std::uint64_t sum = 0;
    const std::vector<unsigned char> &bytes = frames.pack(key, blob, level, sum);
    begin();
    std::int64_t frame = 0;
    std::uint64_t old = 0;
    const bool there = find(key, frame, old);
    Statement &put_frame = database.kept(there ? "UPDATE frames SET bytes = ?1 WHERE number = ?2"
                                               : "INSERT INTO frames(bytes) VALUES(?1)");
    put_frame.bind(1, bytes.data(), bytes.size());
    if (there)
    {
        put_frame.bind(2, frame);
    }
    put_frame.finish();
    if (there && database.changes() != 1)
    {
        fail_file(database.name(), "is damaged: a blob is not there");
    }
    frame = there ? frame : database.last_number();
    Statement &put_key =
        database.kept(there ? "UPDATE directory SET frame = ?2, sum = ?3 WHERE key = ?1"
                            : "INSERT INTO directory VALUES(?1, ?2, ?3)");
    put_key.bind(1, key.bytes, key.count);
    put_key.bind(2, frame);
    put_key.bind(3, static_cast<std::int64_t>(sum));
    put_key.finish();
    totals.keys += !there;
    totals.sum += row_sum(key, frame, sum) - (there ? row_sum(key, frame, old) : 0);
}

void StoreFile::remove(const cm_store_key &key)
{
    std::int64_t frame = 0;
    std::uint64_t sum = 0;
    if (!find(key, frame, sum))
    {
        return;
    }
    begin();
    Statement &row = database.kept("DELETE FROM directory WHERE key = ?1");
    row.bind(1, key.bytes, key.count);
    row.finish();
    Statement &bytes = database.kept("DELETE FROM frames WHERE number = ?1");
    bytes.bind(1, frame);
    bytes.finish();
    totals.keys -= 1;
    totals.sum -= row_sum(key, frame, sum);
}

void StoreFile::next(const cm_store_key &after, unsigned char *key, std::size_t &count)
{
    Statement &row = database.kept("SELECT key FROM directory WHERE key > ?1 ORDER BY key LIMIT 1");
    row.bind(1, after.bytes, after.count);
    if (!row.step())
    {
        count = 0;
        return;
    }
    const cm_store_key found = row.key(0);
    if (found.count < 1 || found.count > CM_STORE_KEY_MAX)
    {
        row.reset();
        fail_file(database.name(), "is damaged: it has a key that is none");
    }
    std::memcpy(key, found.bytes, found.count);
    count = found.count;
    row.reset();
}

void StoreFile::commit()
{
    if (changing)
    {
        end_step();
        changing = false;
    }
}

// The end of the journal is the commit. A disk that fails after it, when asked to keep that, leaves a step that is made and
// that nobody can undo: no failure, if the disk keeps it when it is asked again.
void StoreFile::end_step()
{
    Statement &row = database.kept("UPDATE whole SET keys = ?1, sum = ?2 WHERE number = 1");
    row.bind(1, static_cast<std::int64_t>(totals.keys));
    row.bind(2, static_cast<std::int64_t>(totals.sum));
    row.finish();
    try
    {
        database.run("COMMIT");
    }
    catch (const FileFailure &)
    {
        if (database.in_transaction() || !is_made())
        {
            throw;
        }
        keep_again();
    }
}

bool StoreFile::is_made()
{
    try
    {
        return written_totals() == totals;
    }
    catch (const FileFailure &)
    {
        fail_file(database.name(),
                  "cannot be read: whether the last step is made is seen when it is opened again",
                  CM_ERROR_FILE);
    }
}

// A step that writes the first page as it is.
void StoreFile::keep_again()
{
    try
    {
        for (const std::string &text :
             {std::string("BEGIN IMMEDIATE"), set_version_text(), std::string("COMMIT")})
        {
            database.run(text);
        }
    }
    catch (const FileFailure &)
    {
        fail_file(database.name(),
                  "the step is made, but the disk does not say that it outlives a loss of power",
                  CM_ERROR_FILE);
    }
}

void StoreFile::rollback()
{
    if (changing && database.in_transaction())
    {
        database.run("ROLLBACK"); // SQLite has done it where a disk was full
    }
    changing = false;
    totals = written_totals();
    stuck = CM_OK;
}

template <typename Body> cm_status StoreFile::call(bool changes, const Body &body) noexcept
{
    if (changes && stuck != CM_OK)
    {
        return stuck; // and the message is the same
    }
    const cm_status status = guarded_file(line, body);
    if (status != CM_OK)
    {
        database.reset_all();
    }
    if (status != CM_OK && changes)
    {
        char ignored[CM_IMAGE_MESSAGE];
        guarded_file(ignored, [this] { rollback(); });
        stuck = status;
    }
    return status;
}

StoreFile &store_of(void *context)
{
    return *static_cast<StoreFile *>(context);
}

cm_status get_from_file(void *context, const cm_store_key *key, cm_blob *blob)
{
    return store_of(context).call(false, [&] { store_of(context).get(*key, *blob); });
}

cm_status put_into_file(void *context, const cm_store_key *key, const cm_blob *blob)
{
    if (blob->count > blob_bytes_most)
    {
        return store_of(context).call(
            false,
            [] { throw FileFailure(CM_ERROR_SPACE, "a blob has more bytes than a store takes"); });
    }
    return store_of(context).call(true, [&] { store_of(context).put(*key, *blob); });
}

cm_status remove_from_file(void *context, const cm_store_key *key)
{
    return store_of(context).call(true, [&] { store_of(context).remove(*key); });
}

cm_status next_in_file(void *context, const cm_store_key *after,
                       unsigned char key[CM_STORE_KEY_MAX], size_t *count)
{
    return store_of(context).call(false, [&] { store_of(context).next(*after, key, *count); });
}

cm_status commit_file(void *context)
{
    return store_of(context).call(true, [&] { store_of(context).commit(); });
}

cm_status rollback_file(void *context)
{
    return store_of(context).call(false, [&] { store_of(context).rollback(); });
}

const char *message_of_file(void *context)
{
    return store_of(context).message();
}

void destroy_file(void *context)
{
    delete &store_of(context);
}

} // namespace

cm_status cm_store_file_open(const char *path, const cm_store_file_options *options,
                             cm_store **store, char *message)
{
    static const cm_store_methods methods = {sizeof methods,   get_from_file,   put_into_file,
                                             remove_from_file, next_in_file,    commit_file,
                                             rollback_file,    message_of_file, destroy_file};
    const cm_store_file_options plain = {sizeof plain, 0, 0, 0};
    const cm_store_file_options &wanted = options == nullptr ? plain : *options;
    if (path == nullptr || store == nullptr || wanted.size != sizeof wanted || wanted.level < 0 ||
        wanted.level > 19)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message,
                        [&]
                        {
                            std::unique_ptr<StoreFile> made =
                                std::make_unique<StoreFile>(path, wanted);
                            if (cm_store_create(&methods, made.get(), store) != CM_OK)
                            {
                                throw std::bad_alloc();
                            }
                            made.release();
                        });
}
